#include "app/tolerance_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "design/tolerance/figures.h"

namespace evenglow::app {
namespace {

using testing::HasSubstr;

class ToleranceReport : public ::testing::Test {
 protected:
  ToleranceReport() {
    job_.nominal.title = "phone <1>";
    job_.nominal.tolerance.limits = {{"uniformity_9", 0.795, {}}, {"efficiency", {}, 2.0}};
    design::Variation growth;
    growth.kind = design::VariationKind::dot_growth;
    growth.name = "dot_growth_um";
    job_.nominal.tolerance.variations = {growth};
    run_.reference.assign(design::kFigures.size(), {0.9, 0.01});
    for (int i = 0; i < 20; ++i) {
      std::vector<core::Estimate> figures(design::kFigures.size(), {0.7 + 0.01 * i, 0.001});
      run_.samples.push_back({{0.5 * i}, figures, {{0.7 + 0.01 * i, 0.7 + 0.01 * i}, {0.9, 0.9}}});
      run_.maps.add({core::CellField(core::CellGrid::over(2, 2, 0, 0, 1, 1), 100.0 + i),
                     core::CellField(core::CellGrid::over(2, 2, 0, 0, 1, 1), 0.1)});
    }
    summary_ = summarize(job_.nominal.tolerance, run_);
  }
  ToleranceOutcome outcome() const { return {job_, run_, summary_, "evenglow tolerance phone.yaml"}; }

  ToleranceJob job_;
  design::ToleranceSamples run_;
  design::ToleranceSummary summary_;
};

TEST_F(ToleranceReport, TableHasARowForEachSample) {
  const std::string csv = tolerance_csv(outcome());
  EXPECT_THAT(csv, HasSubstr("sample,dot_growth_um,rms_corrected,rms_corrected_se,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  EXPECT_THAT(csv, HasSubstr("\n1,0,0.7,0.001,"));
  EXPECT_THAT(csv, HasSubstr(",0\n2,0.5,"));
  EXPECT_EQ(csv.substr(csv.size() - 3), ",1\n");
}

TEST_F(ToleranceReport, JsonTellsYieldSpreadAndSensitivity) {
  const auto json = nlohmann::json::parse(tolerance_json(outcome()));
  EXPECT_EQ(json["yield"]["passed"], 10);
  EXPECT_EQ(json["limits"]["uniformity_9"]["min"], 0.795);
  const auto& figure = json["figures"]["uniformity_9"];
  EXPECT_NEAR(figure["spread_seen"].get<double>(), 0.01 * std::sqrt(35.0), 1e-9);
  EXPECT_NEAR(figure["sensitivity"]["per_standard_deviation"]["dot_growth_um"]["effect"].get<double>(),
              0.01 * std::sqrt(35.0), 1e-9);
  EXPECT_EQ(json["worst"][0], 1);
}

TEST_F(ToleranceReport, YieldRowsEndWithAllLimits) {
  const auto rows = yield_rows(outcome());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].size(), yield_columns().size());
  EXPECT_EQ(rows[0][1], "at least 79.50 %");
  EXPECT_EQ(rows[2][0], "all limits");
  EXPECT_EQ(rows[2][2], "10 of 20");
}

TEST_F(ToleranceReport, PageIsWholeAndEscaped) {
  const std::string html = tolerance_html(outcome());
  EXPECT_THAT(html, HasSubstr("phone &lt;1&gt;"));
  for (const char* part :
       {"Yield", "What the spread comes from", "The worst samples", "--sample 1 ", "Spread of the shape"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, testing::Not(HasSubstr(">nan")));
}

}  // namespace
}  // namespace evenglow::app
