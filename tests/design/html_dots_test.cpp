#include "design/report/html_dots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/report/csv_writer.h"
#include "design/report/json_dots.h"
#include "design/report/json_writer.h"
#include "tests/design/report_samples.h"

/// What the reports tell of a design's real dots.
namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

Report with_dots() {
  Report r = samples::report();
  DotsJudgment dots;
  for (int i = 0; i < 2; ++i) {
    DotsRound round;
    round.dots = 250000 + static_cast<std::size_t>(i);
    round.area = 715.1;
    round.record.step = i;
    round.record.photons = 4000000;
    round.record.rms_corrected = {0.02 - 0.01 * i, 0.001};
    round.luminance = {990.0, 2.0};
    round.over_density = {0.99, 0.003};
    dots.rounds.push_back(round);
  }
  dots.chosen = 1;
  dots.stop_reason = "reached: <enough>";
  dots.final = r.final;
  dots.final.rms_corrected = {0.0123, 0.001};
  dots.over_density = {0.98, 0.004};
  dots.luminance = samples::ramp(6, 4, 980.0);
  dots.luminance_se = samples::ramp(6, 4, 10.0);
  dots.density = samples::ramp(8, 4, 0.11);
  r.dots = dots;
  return r;
}

TEST(HtmlDots, SectionShowsBothJudgmentsRoundsAndMaps) {
  PageData data;
  const std::string html = dots_section(with_dots(), "", data);
  EXPECT_THAT(html, HasSubstr("The design as real dots"));
  EXPECT_THAT(html, HasSubstr("reached: &lt;enough&gt;"));
  EXPECT_THAT(html, HasSubstr("<td>chosen</td>"));
  EXPECT_THAT(html, HasSubstr("1.23"));
  for (const char* map : {"Luminance of the density", "Luminance of the dots", "Dots over density"})
    EXPECT_THAT(html, HasSubstr(map));
  EXPECT_THAT(html, HasSubstr("mean 0.9800, 0.9800"));
  EXPECT_EQ(dots_section(samples::report(), "", data), "");
}

TEST(HtmlDots, ResultJsonHoldsTheBlock) {
  const auto json = dots_json(with_dots());
  EXPECT_EQ(json["dots"], 250001);
  EXPECT_EQ(json["chosen_round"], 1);
  EXPECT_EQ(json["rounds"].size(), 2U);
  EXPECT_EQ(json["rounds"][0]["rms_corrected"], 0.02);
  EXPECT_EQ(json["final"]["rms_corrected"], 0.0123);
  EXPECT_EQ(json["density_model"]["rms_corrected"], 0.1);
  EXPECT_EQ(json["luminance_over_density"], 0.98);
  EXPECT_THAT(result_json(with_dots()), HasSubstr("\"chosen_round\": 1"));
  EXPECT_THAT(result_json(samples::report()), ::testing::Not(HasSubstr("chosen_round")));
}

TEST(HtmlDots, MatricesOfTheDots) {
  const samples::Folder folder("html_dots");
  CsvWriter().write(with_dots(), folder.path());
  EXPECT_THAT(samples::content(folder.path() / "dots_luminance.csv"), HasSubstr("# luminance of the dots (cd/m2)"));
  EXPECT_THAT(samples::content(folder.path() / "dots_density.csv"), HasSubstr("dots were placed for"));
  EXPECT_FALSE(samples::content(folder.path() / "dots_luminance_se.csv").empty());
}

}  // namespace
}  // namespace evenglow::design
