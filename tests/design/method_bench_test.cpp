#include "design/engine/method_bench.h"

#include <gtest/gtest.h>

#include "core/montecarlo/batches.h"
#include "tests/support/coupled_backlight.h"

namespace evenglow::design {
namespace {

TEST(MethodBench, CountsUntilATraceShowsTheThreshold) {
  const tests::CoupledBacklight backlight;
  const ForwardModel model = backlight;
  DesignSpec spec;
  spec.updater = "ratio_noise_aware";
  spec.stop_rms = 0.005;
  spec.density_min = 1e-4;
  spec.level = 0.1;
  const auto trial =
      run_trial(model, spec, {{100000, 16000000}}, {core::CellField(backlight.grid, 0.1)}, {0.5, 0.05, 0.01, 1e-5});
  ASSERT_TRUE(trial);
  ASSERT_TRUE(trial->efforts[0] && trial->efforts[1] && trial->efforts[2]);
  EXPECT_FALSE(trial->efforts[3]);
  EXPECT_EQ(trial->efforts[0]->steps, 0);
  EXPECT_EQ(trial->efforts[0]->photons, 100000U);
  std::uint64_t photons = 0;
  for (const StepRecord& record : trial->steps) {
    photons += record.photons;
    if (record.step == trial->efforts[2]->steps) {
      EXPECT_LE(record.rms_corrected.value, 0.01);
      EXPECT_LE(record.rms_corrected.se, 0.005);
      EXPECT_EQ(photons, trial->efforts[2]->photons);
    }
  }
  EXPECT_NEAR(trial->judged.rms_corrected.value, 0.005, 0.003);
}

/// The ratio on a noisy backlight never reaches the threshold; the budget ends it, and what it made is judged by
/// another model.
TEST(MethodBench, EndsAtItsBudget) {
  tests::CoupledBacklight backlight;
  const ForwardModel good = backlight;
  backlight.noise = 0.2;
  const ForwardModel noisy = [&](const auto& density, auto photons, auto step) {
    const double until = core::process_cpu_seconds() + 0.005;
    while (core::process_cpu_seconds() < until) {
    }
    return backlight(density, photons, step);
  };
  DesignSpec spec;
  spec.updater = "ratio";
  spec.stop_rms = 1e-6;
  spec.density_min = 1e-4;
  spec.level = 0.1;
  spec.max_steps = 1000;
  TrialLimits limits{{100000, 1000000}};
  limits.cpu_s = 1e-9;
  limits.judging_photons = 16000000;
  limits.judging_model = &good;
  EXPECT_FALSE(run_trial(noisy, spec, limits, {core::CellField(backlight.grid, 0.1)}, {0.5})) << "not even a start";
  limits.cpu_s = 0.01;
  const auto trial = run_trial(noisy, spec, limits, {core::CellField(backlight.grid, 0.1)}, {1e-5});
  ASSERT_TRUE(trial);
  EXPECT_EQ(trial->stop_reason, "budget: 0.01 CPU seconds were spent");
  EXPECT_EQ(trial->spent.cpu_s, trial->cpu_s.back());
  EXPECT_EQ(trial->spent.steps + 1, static_cast<int>(trial->steps.size()));
  EXPECT_EQ(trial->judged.photons, 16000000U);
  EXPECT_LT(trial->judged.rms_corrected.se, 1e-3);
  limits.cpu_s = 0.0;
  EXPECT_EQ(
      run_trial(noisy, spec, limits, {core::CellField(backlight.grid, 0.1)}, {1e-5})->stop_reason.rfind("stalled", 0),
      0U);
}

TEST(MethodBench, MediansOfThoseThatReachedIt) {
  std::vector<MethodTrial> trials(4);
  for (std::size_t i = 0; i < 4; ++i) {
    trials[i].updater = i == 3 ? "other" : "auto";
    trials[i].efforts = {Effort{static_cast<int>(i) + 1, 100 * (i + 1), 1.0 * static_cast<double>(i)}};
  }
  trials[1].efforts[0].reset();
  trials[1].spent = {9, 900, 90.0};
  const EffortSummary s = summarize(trials, "auto", 0);
  EXPECT_EQ(s.trials, 3);
  EXPECT_EQ(s.reached, 2);
  EXPECT_EQ(s.steps, 2.0);
  EXPECT_EQ(s.photons_low, 100.0);
  EXPECT_EQ(s.photons_high, 300.0);
  EXPECT_EQ(s.in_vain.steps, 9);
  EXPECT_EQ(s.in_vain.cpu_s, 90.0);
  EXPECT_EQ(summarize(trials, "other", 0).in_vain.cpu_s, 0.0);
}

}  // namespace
}  // namespace evenglow::design
