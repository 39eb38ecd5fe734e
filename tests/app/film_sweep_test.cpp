#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow film sweep` as a user runs it.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class FilmSweepCommand : public ::testing::Test {
 protected:
  ProgramResult run(const std::vector<std::string>& options) const {
    std::vector<std::string> words{"film", "sweep"};
    words.insert(words.end(), options.begin(), options.end());
    return evenglow(words, folder_.path());
  }
  std::vector<std::vector<std::string>> table(const std::string& name) const {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(file_text(folder_ / name));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#")) continue;
      rows.emplace_back();
      std::istringstream cells(line + ",");
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
  }

  TempFolder folder_;
};

TEST_F(FilmSweepCommand, WritesATableAndAPicture) {
  write_text(folder_ / "film.yaml", "film: {kind: lpp, axis_deg: 30, k1: 0.8, k2: 0.2, reflectance: 0.1}\n");
  const auto result = run({"film.yaml", "--sigma", "0:80:20", "--azimuth", "0,45", "--wavelength", "450,550",
                           "--polarization", "all", "-o", "out.csv"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("0.8000"));
  EXPECT_THAT(result.out, HasSubstr("60 rows more"));
  const auto rows = table("out.csv");
  ASSERT_THAT(rows, SizeIs(1 + 5 * 2 * 2 * 6));
  for (const auto& row : rows) ASSERT_THAT(row, SizeIs(26));
  EXPECT_EQ(rows[0][6], "transmittance");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double expected = rows[i][2] == "pass" ? 0.8 : rows[i][2] == "block" ? 0.2 : 0.5;
    EXPECT_NEAR(std::stod(rows[i][6]), expected, 1e-7);
    EXPECT_EQ(rows[i][7], "0");
  }
  EXPECT_THAT(file_text(folder_ / "out.png").substr(1, 3), "PNG");
  const auto again = run({"film.yaml", "-o", "out.csv"});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("out.csv"));
  EXPECT_EQ(run({"film.yaml", "-o", "out.csv", "--overwrite"}).code, 0);
}

TEST_F(FilmSweepCommand, CountsPhotonsOfScatteringFilms) {
  write_text(folder_ / "run.yaml", std::string(kTinyRun));
  const auto result = run({"run.yaml", "--film", "0", "--sigma", "0,60", "--polarization", "none", "--photons", "5e3",
                           "--seed", "3", "--from", "above", "--quiet", "-o", "out.csv"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("±"));
  const auto rows = table("out.csv");
  ASSERT_THAT(rows, SizeIs(3));
  const double p = std::stod(rows[1][6]), se = std::stod(rows[1][7]);
  EXPECT_NEAR(se, std::sqrt(p * (1 - p) / 5e3), 1e-5);
  EXPECT_NEAR(p, 0.88, 4 * se);
}

TEST_F(FilmSweepCommand, RefusesInOneLine) {
  write_text(folder_ / "film.yaml", "film: {kind: lpp}\n");
  write_text(folder_ / "bad.yaml", "film: {kind: lpp, k1: 2}\n");
  write_text(folder_ / "run.yaml", std::string(kTinyRun));
  for (const auto& [words, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"film.yaml", "--sigma", "0:90:1"}, "--sigma: must lie in [0, 90)"},
           {{"film.yaml", "--wavelength", "20"}, "--wavelength: must lie in [300, 2000]"},
           {{"film.yaml", "--azimuth", "x"}, "--azimuth"},
           {{"film.yaml", "--polarization", "oval"}, "--polarization"},
           {{"film.yaml", "--photons", "0"}, "--photons"},
           {{"film.yaml", "--from", "left"}, "--from"},
           {{"film.yaml", "--film", "1"}, "--film"},
           {{"film.yaml", "-o", "out.png"}, "--out"},
           {{"film.yaml", "--sigma", "0:80:0.01", "--azimuth", "0:359:1"}, "at most 200000 rows"},
           {{"run.yaml"}, "--film: must say which"},
           {{"no.yaml"}, "no.yaml"},
           {{"bad.yaml"}, "bad.yaml:1:23: film.k1: must lie in [0, 1], got 2"}}) {
    const auto result = run(words);
    EXPECT_EQ(result.code, 2) << text;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_THAT(result.err_lines(), SizeIs(1)) << result.err;
  }
}

TEST_F(FilmSweepCommand, HelpTellsUnitsAndAnExample) {
  const auto result = run({"--help"});
  EXPECT_EQ(result.code, 0);
  for (const char* word : {"degrees", "nm", "Example: evenglow film sweep"}) EXPECT_THAT(result.out, HasSubstr(word));
}

TEST_F(FilmSweepCommand, NeverReplacesItsFile) {
  const std::string film = "film: {kind: lpp}\n";
  for (const auto& [in, out] : {std::pair{"film.yaml", "./film.yaml"}, std::pair{"film.png", "film.csv"}}) {
    write_text(folder_ / in, film);
    const auto result = run({in, "-o", out, "--overwrite"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(std::string(in) + ": must be another file than the input"));
    EXPECT_EQ(file_text(folder_ / in), film);
  }
}

}  // namespace
}  // namespace evenglow::tests
