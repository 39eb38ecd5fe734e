#include "design/engine/stop_rule.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "design/engine/step_judgment.h"

namespace evenglow::design {
namespace {

StepRecord record_of(int step, double rms, double se, std::uint64_t photons = 1000, double noise = 0.0) {
  StepRecord record;
  record.step = step;
  record.rms_corrected = {rms, se};
  record.photons = photons;
  record.noise = noise;
  return record;
}

DesignSpec spec_of(double stop_rms) {
  DesignSpec spec;
  spec.stop_rms = stop_rms;
  return spec;
}

TEST(StopRule, IsReachedWhereTheErrorLiesBelowTheBoundToo) {
  const DesignSpec spec = spec_of(0.01);
  EXPECT_TRUE(reached(record_of(1, 0.0084, 0.0015), spec));
  EXPECT_FALSE(reached(record_of(1, 0.0089, 0.0015), spec)) << "turned out at 1.13 % once";
  EXPECT_TRUE(reached(record_of(1, -0.002, 0.003), spec));
  EXPECT_FALSE(reached(record_of(1, -0.0039, 0.0080), spec)) << "turned out at 1.21 % once: its square hardly tells";
}

/// A map whose RMS is `rms` exactly, seen with noise in 20 batches.
StepRecord seen(double rms, double noise, unsigned seed) {
  const core::CellGrid grid = core::CellGrid::over(20, 10, 0, 0, 20, 10);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  constexpr int kBatches = 20;
  Observation o;
  o.luminance = core::Tally(grid.size());
  for (int b = 0; b < kBatches; ++b) {
    std::vector<double> batch;
    for (std::size_t i = 0; i < grid.size(); ++i)
      batch.push_back(1.0 + (i % 2 == 0 ? rms : -rms) + noise * std::sqrt(1.0 * kBatches) * normal(random));
    o.luminance.add_batch(std::move(batch));
  }
  o.map = {{grid, 1.0}, {grid, 0.0}};
  return make_step_record(1, {core::CellField(grid, 0.1)}, o, spec_of(0.01));
}

/// The chances that the header states. 1000 repetitions: standard error of a share of 16 % is 1.2 %, of 3 % 0.5 %; four
/// of them either way (three comparisons: false alarm 2e-4), and a little more, for the error of a trace is itself
/// known from its batches only.
TEST(StopRule, PassesWhatLiesAtTheBoundWithTheStatedChance) {
  const DesignSpec spec = spec_of(0.01);
  for (const double noise : {0.015, 0.022}) {  // error of the square: 0.3 and 0.5 of that of the bound
    int at_bound = 0, above = 0, below = 0;
    for (unsigned i = 0; i < 1000; ++i) {
      at_bound += reached(seen(0.01, noise, i), spec) ? 1 : 0;
      above += reached(seen(0.012, noise, 10000 + i), spec) ? 1 : 0;
      below += reached(seen(0.005, 0.5 * noise, 20000 + i), spec) ? 1 : 0;
    }
    EXPECT_LT(at_bound, 210) << noise;
    EXPECT_LT(above, 55) << noise;
    EXPECT_GT(below, 950) << noise;
    if (noise < 0.02) {
      EXPECT_GT(at_bound, 110);
    }
  }
}

TEST(StopRule, NamesTheReason) {
  const DesignLimits limits{1000, 1000};
  DesignSpec spec = spec_of(0.01);
  const std::vector<StepRecord> even = {record_of(0, 0.5, 0.01), record_of(1, 0.008, 0.001)};
  EXPECT_EQ(stop_reason({even, 0.008, 4, true}, spec, limits),
            "reached: the noise-corrected RMS is 0.80 +- 0.10 % (wanted 1.00 %)");
  EXPECT_EQ(stop_reason({even, 0.008, 4, false}, spec, limits), "") << "the level moves";
  std::vector<StepRecord> stuck;
  for (int i = 0; i < 6; ++i) stuck.push_back(record_of(i, 0.05, 0.001));
  EXPECT_EQ(stop_reason({stuck, 0.05, 4, true}, spec, limits), "stalled: no better than 5.00 % in the last 4 steps");
  EXPECT_EQ(stop_reason({stuck, kNoneYet, 4, true}, spec, limits),
            "stalled: the noise of the traces hides the RMS (more photons would tell)");
  EXPECT_EQ(stop_reason({stuck, 0.05, 8, true}, spec, limits), "") << "searches have more patience";
  spec.max_steps = 5;
  EXPECT_EQ(stop_reason({stuck, 0.05, 8, true}, spec, limits), "max_steps: 5 steps were made");
}

TEST(StopRule, SaysWhereTheIndependentTraceShowsMore) {
  const std::string reason = "reached: the noise-corrected RMS is 0.80 +- 0.10 % (wanted 1.00 %)";
  FinalJudgment judged;
  judged.rms_corrected = {0.0095, 0.001};
  EXPECT_EQ(confirmed_reason(reason, judged, 0.01), reason);
  judged.rms_corrected = {0.0113, 0.0005};
  EXPECT_EQ(confirmed_reason(reason, judged, 0.01),
            "missed: the independent trace shows an RMS of 1.13 +- 0.05 % (wanted 1.00 %); before it, the "
            "noise-corrected RMS is 0.80 +- 0.10 % (wanted 1.00 %)");
  judged.rms_corrected = {0.0105, 0.0005};
  EXPECT_EQ(confirmed_reason(reason, judged, 0.01),
            reason + "; the independent trace shows 1.05 +- 0.05 %: above the bound, but within its error");
  EXPECT_EQ(confirmed_reason("stalled: x", judged, 0.01), "stalled: x");
}

/// A step that was lucky to below zero is no measure for those after it, nor is one of another level.
TEST(StopRule, DoesNotStallOnALuckyStepOrAnotherLevel) {
  const DesignLimits limits{1000, 1000};
  const auto course = [](double first, double first_level) {
    std::vector<StepRecord> steps;
    for (const double rms : {first, 0.578, 0.402, 0.302, 0.239, 0.192}) {
      steps.push_back(record_of(static_cast<int>(steps.size()), rms, 0.01));
      steps.back().mean_density = 0.2;
      steps.back().photons = 1000;
    }
    steps.front().mean_density = first_level;
    return steps;
  };
  EXPECT_EQ(stop_reason({course(-0.05, 0.2), 0.0, 4, true}, spec_of(0.01), limits), "");
  EXPECT_EQ(stop_reason({course(0.1, 0.07), 0.0, 4, true}, spec_of(0.01), limits), "");
  EXPECT_NE(stop_reason({course(0.1, 0.2), 0.1, 4, true}, spec_of(0.01), limits), "");
}

TEST(StopRule, ABoundIsShownOnlyWhereTheNoiseLetsItBeSeen) {
  EXPECT_TRUE(shows_bound({0.010, 0.001}, 0.01));
  EXPECT_FALSE(shows_bound({0.013, 0.001}, 0.01));
  EXPECT_FALSE(shows_bound({0.0136, 0.0119}, 0.01)) << "noise hides it";
  EXPECT_FALSE(shows_bound({-0.02, 0.015}, 0.01));
}

TEST(StopRule, TellsThatTheEfficiencyIsMissed) {
  FinalJudgment judged;
  judged.efficiency = {0.679, 0.001};
  GoalSpec goal;
  goal.kind = "min_rms";
  goal.efficiency = 0.95;
  EXPECT_EQ(
      confirmed_goal("reached: x", judged, goal),
      "missed: the independent trace shows an efficiency of 67.90 +- 0.10 % (wanted 95.00 %); before it, reached: "
      "x");
  goal.efficiency = 0.68;
  EXPECT_EQ(confirmed_goal("reached: x", judged, goal), "reached: x");
}

}  // namespace
}  // namespace evenglow::design
