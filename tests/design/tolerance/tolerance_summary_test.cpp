#include "design/tolerance/tolerance_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/tolerance/figures.h"

namespace evenglow::design {
namespace {

using testing::ElementsAre;

/// Samples whose RMS and uniformity are given, all else alike.
ToleranceSamples samples_of(const std::vector<std::pair<double, double>>& rms_and_uniformity) {
  ToleranceSamples run;
  run.reference.assign(kFigures.size(), {1.0, 0.01});
  run.shift.assign(kFigures.size(), {});
  run.shift[1] = {-0.02, 0.001};
  for (const auto& [rms, uniformity] : rms_and_uniformity) {
    SampleResult s{{rms}, std::vector<core::Estimate>(kFigures.size(), {1.0, 0.01})};
    s.figures[0] = {rms, 0.0};
    s.figures[1] = {uniformity, 0.0};
    run.samples.push_back(std::move(s));
  }
  return run;
}

TEST(ToleranceSummary, RanksByTheTightestLimit) {
  ToleranceSpec spec;
  spec.limits = {{"rms_corrected", {}, 0.05}, {"uniformity_9", 0.8, {}}};
  const auto run = samples_of({{0.01, 0.95}, {0.06, 0.90}, {0.03, 0.70}, {0.04, 0.92}});
  const ToleranceSummary s = summarize(spec, run);
  EXPECT_THAT(s.worst, ElementsAre(3, 2, 4, 1));
  ASSERT_TRUE(s.all);
  EXPECT_EQ(s.yields[0].passed, 3);
  EXPECT_EQ(s.yields[1].passed, 3);
  EXPECT_EQ(s.all->passed, 2);
}

TEST(ToleranceSummary, RanksByTheRmsWithoutLimits) {
  const ToleranceSummary s = summarize({}, samples_of({{0.01, 0.95}, {0.06, 0.90}, {0.03, 0.70}}));
  EXPECT_THAT(s.worst, ElementsAre(2, 3, 1));
  EXPECT_FALSE(s.all);
}

TEST(ToleranceSummary, TakesTheShiftOfTheNoiseOff) {
  const auto run = samples_of({{0.01, 0.95}, {0.06, 0.90}, {0.03, 0.70}});
  const ToleranceSummary s = summarize({}, run);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(s.figures[1].corrected[i], run.samples[i].figures[1].value + 0.02, 1e-12);
}

}  // namespace
}  // namespace evenglow::design
