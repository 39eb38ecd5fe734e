#include "design/tolerance/tolerance_summary.h"

#include <cmath>

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
  for (const auto& [rms, uniformity] : rms_and_uniformity) {
    SampleResult s{{rms}, std::vector<core::Estimate>(kFigures.size(), {1.0, 0.01})};
    s.figures[0] = {rms, 0.0};
    s.figures[1] = {uniformity, 0.0};
    s.halves = {{uniformity, uniformity}, {1.0, 1.0}};
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

/// Halves that lie 0.02 lower and 0.04 apart: a noise of 0.02, a shift of -0.02 / (sqrt(2) - 1).
TEST(ToleranceSummary, TakesTheNoiseOfTheHalvesOff) {
  auto run = samples_of({{0.01, 0.95}, {0.06, 0.90}, {0.03, 0.70}});
  for (SampleResult& s : run.samples) {
    const double u = s.figures[1].value;
    s.halves.nine = {u - 0.04, u};
    s.figures[1].se = 77.0;  // that of the jackknife does not count
  }
  ToleranceSpec spec;
  spec.limits = {{"uniformity_9", 0.93, {}}};
  const ToleranceSummary s = summarize(spec, run);
  EXPECT_NEAR(s.figures[1].population.noise, 0.02, 1e-12);
  EXPECT_NEAR(s.figures[1].shift.value, -0.02 / (std::sqrt(2.0) - 1.0), 1e-12);
  double mean = 0.0;
  for (const double v : s.figures[1].corrected) mean += v / 3.0;
  EXPECT_NEAR(mean, 0.85 + 0.02 / (std::sqrt(2.0) - 1.0), 1e-12);
  EXPECT_EQ(s.yields[0].near_limit, 1) << "0.90 is 0.948 without the shift: within two noises of 0.93; 0.95 is not";
}

}  // namespace
}  // namespace evenglow::design
