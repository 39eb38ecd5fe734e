#include "design/report/csv_writer.h"

#include <sstream>

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::vector<std::vector<std::string>> cells(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

TEST(CsvWriter, MatrixReadsBackAsItWas) {
  core::CellField field = samples::ramp(3, 2, 1.0);
  field.values[4] = 0.1 + 0.2;
  const std::string csv = matrix_csv(field, "luminance (cd/m2)");
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "# luminance (cd/m2); 2 rows = y, 3 columns = x; cell 4 mm x 3 mm; first corner at x 0 mm, y 0 mm");
  const auto rows = cells(csv);
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t iy = 0; iy < 2; ++iy) {
    ASSERT_EQ(rows[iy].size(), 3U);
    for (std::size_t ix = 0; ix < 3; ++ix) EXPECT_EQ(std::stod(rows[iy][ix]), field.values[iy * 3 + ix]);
  }
}

TEST(CsvWriter, ConvergenceHasThePromisedColumns) {
  Report report = samples::report();
  report.steps[2].noise = 0.03;
  report.steps[2].held_high = 7;
  report.steps[2].updater = "anderson";
  const auto rows = cells(convergence_csv(report));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"step", "photons", "rms", "rms_corrected", "rms_corrected_se", "efficiency",
                                      "efficiency_se", "mean_density", "luminance_mean_cd_m2", "cpu_s", "wall_s",
                                      "noise", "held_low", "held_high", "level_photons", "updater"}));
  EXPECT_EQ(rows[3], (std::vector<std::string>{"2", "1000000", "0.09999999999999999", "0.09666666666666666", "0.001",
                                               "0.5", "0.002", "0.1", "902", "2.5", "1.25", "0.03", "0", "7", "0",
                                               "anderson"}));
}

TEST(CsvWriter, AngularTableHasTheEdgesOfEachBin) {
  AngularLuminance angular{{0, 45, 90}, 2, {{1, 0.1}, {2, 0.2}, {3, 0.3}, {4, 0.4}}};
  const auto rows = cells(angular_csv(angular));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[4], (std::vector<std::string>{"45", "90", "180", "360", "4", "0.4"}));
}

TEST(CsvWriter, ComparisonHasARowForEachVariant) {
  Report twice = samples::report("b,c");
  twice.final.luminance_mean.value = 2000.0;
  const std::string csv = comparison_csv(compare_reports("t", "c", {samples::report("a"), twice}));
  EXPECT_NE(csv.find("\na,100,1000,3,"), std::string::npos);
  EXPECT_NE(csv.find("\n\"b,c\",100,2000,3,0.1,0.001,0.9,0.8,0.5,0.001,2,"), std::string::npos);
}

TEST(CsvWriter, WritesWhatThereIs) {
  const samples::Folder folder("csv");
  Report r = samples::report();
  r.luminance_se = {};
  r.angular.reset();
  CsvWriter().write(r, folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "luminance.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "density.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "luminance_se.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "angular.csv"));
}

}  // namespace
}  // namespace evenglow::design
