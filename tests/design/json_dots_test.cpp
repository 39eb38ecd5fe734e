#include "design/report/json_dots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/report/json_writer.h"
#include "tests/design/dots_report.h"

namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

TEST(JsonDots, ResultJsonHoldsTheBlock) {
  const auto json = dots_json(samples::with_dots());
  EXPECT_EQ(json["dots"], 250001);
  EXPECT_EQ(json["chosen_round"], 1);
  EXPECT_EQ(json["rounds"].size(), 2U);
  EXPECT_EQ(json["rounds"][0]["rms_corrected"], 0.02);
  EXPECT_EQ(json["final"]["rms_corrected"], 0.0123);
  EXPECT_EQ(json["density_model"]["rms_corrected"], 0.1);
  EXPECT_EQ(json["luminance_over_density"], 0.98);
  EXPECT_THAT(result_json(samples::with_dots()), HasSubstr("\"chosen_round\": 1"));
  EXPECT_THAT(result_json(samples::report()), ::testing::Not(HasSubstr("chosen_round")));
}

TEST(JsonDots, EveryRoundAndBothJudgmentsAreTold) {
  const Report report = samples::with_dots();
  const auto json = dots_json(report);
  EXPECT_EQ(json["rounds"][0]["dots"], 250000);
  EXPECT_EQ(json["rounds"][1]["round"], 1);
  EXPECT_EQ(json["rounds"][1]["photons"], 4000000);
  EXPECT_EQ(json["rounds"][1]["luminance_over_density_se"], 0.003);
  EXPECT_EQ(json["luminance_over_density"], 0.98);
  EXPECT_EQ(json["final"]["rms_corrected"], 0.0123);
  EXPECT_EQ(json["density_model"]["rms_corrected"], report.final.rms_corrected.value);
  EXPECT_EQ(json["stop_reason"], "reached: <enough>");
}

}  // namespace
}  // namespace evenglow::design
