#include "design/engine/design_loop.h"

#include <gtest/gtest.h>

#include "design/engine/checkpoint.h"
#include "design/updaters/updater.h"
#include "tests/support/analytic_backlight.h"

namespace evenglow::design {
namespace {

tracer::DensityField flat(const core::CellGrid& grid, double density) {
  return {core::CellField(grid, density)};
}

DesignSpec spec_of(const std::string& updater, double stop_rms) {
  DesignSpec spec;
  spec.updater = updater;
  spec.stop_rms = stop_rms;
  spec.density_min = 0.001;
  spec.density_max = 0.9;
  return spec;
}

DesignProgress designed(const tests::AnalyticBacklight& model, const DesignSpec& spec,
                        DesignLimits limits = {200000, 16000000}) {
  return run_design(model, spec, limits, start_design(flat(model.grid, 0.1), spec, limits),
                    [](const StepRecord&, const DesignProgress&) {});
}

/// RMS of the analytic luminance: no noise at all.
double true_rms(const tests::AnalyticBacklight& model, const tracer::DensityField& density) {
  const auto L = model.luminance(density);
  double mean = 0.0;
  for (const double v : L) mean += v / static_cast<double>(L.size());
  double squares = 0.0;
  for (const double v : L) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(L.size())) / mean;
}

// Outcomes, not densities: every updater must reach the wanted evenness of the noise-free model, from an uneven start.
TEST(DesignLoop, EveryUpdaterReachesTheWantedEvenness) {
  const tests::AnalyticBacklight model;
  for (const UpdaterEntry& entry : updater_registry()) {
    const DesignSpec spec = spec_of(entry.name, 0.01);
    ASSERT_GT(true_rms(model, flat(model.grid, 0.1)), 0.2);
    const DesignProgress progress = designed(model, spec);
    EXPECT_EQ(progress.stop_reason.rfind("reached", 0), 0U) << entry.name << ": " << progress.stop_reason;
    EXPECT_LT(true_rms(model, progress.best_density), 0.012) << entry.name;
  }
}

TEST(DesignLoop, NoiseAwareUpdaterBeatsThePlainOneAtEqualPhotons) {
  tests::AnalyticBacklight model;
  model.noise = 0.1;
  DesignSpec spec = spec_of("ratio", 1e-6);
  spec.max_steps = 8;
  spec.photon_growth = 1.0;
  spec.level = 0.1;
  const double plain = true_rms(model, designed(model, spec, {1000000, 1000000}).density);
  spec.updater = "ratio_noise_aware";
  const double aware = true_rms(model, designed(model, spec, {1000000, 1000000}).density);
  EXPECT_GT(plain, 0.05);
  EXPECT_LT(aware, 0.5 * plain);
}

TEST(DesignLoop, KeepsTheLimitsAndTellsOfThem) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("ratio", 1e-4);
  spec.density_min = 0.08;
  spec.density_max = 0.2;
  spec.max_steps = 6;
  const DesignProgress progress = designed(model, spec);
  EXPECT_GE(progress.density.cells.min(), 0.08);
  EXPECT_LE(progress.density.cells.max(), 0.2);
  ASSERT_FALSE(progress.limit_notes.empty());
  EXPECT_NE(progress.limit_notes.front().find("limit of the density"), std::string::npos);
}

TEST(DesignLoop, FixedLevelIsKept) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("ratio_noise_aware", 0.01);
  spec.level = 0.07;
  const DesignProgress progress = designed(model, spec);
  EXPECT_NEAR(progress.best_density.cells.mean(), 0.07, 0.002);
  EXPECT_TRUE(progress.level_note.empty());
}

TEST(DesignLoop, FreeLevelIsTheLowestWithinTwoPercentOfTheBest) {
  const tests::AnalyticBacklight model;
  const DesignSpec spec = spec_of("ratio_noise_aware", 0.01);
  const DesignProgress progress = designed(model, spec);
  EXPECT_NE(progress.level_note.find("chosen"), std::string::npos);
  // Efficiency grows with the level in this model and far from saturation: the level must have gone up.
  EXPECT_GT(progress.best_density.cells.mean(), 0.13);
}

TEST(DesignLoop, GoesOnFromACheckpointToTheSameBits) {
  const tests::AnalyticBacklight model;
  const DesignSpec spec = spec_of("ratio_noise_aware", 0.005);
  const DesignLimits limits{200000, 16000000};
  const auto file = std::filesystem::path(testing::TempDir()) / "evenglow_design_loop_checkpoint.json";
  std::filesystem::remove(file);
  const DesignProgress whole = designed(model, spec, limits);
  int left = 3;
  const ForwardModel interrupted = [&](const auto& density, auto photons, auto step) {
    return step < 0x80000000U && left-- <= 0 ? std::nullopt : model(density, photons, step);
  };
  const DesignProgress part =
      run_design(interrupted, spec, limits, start_design(flat(model.grid, 0.1), spec, limits),
                 [&](const StepRecord&, const DesignProgress& p) { save_checkpoint(file, "me", p); });
  EXPECT_TRUE(part.stop_reason.empty());
  auto loaded = load_checkpoint(file, "me");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->steps.size(), 3U);
  const DesignProgress rest =
      run_design(model, spec, limits, std::move(*loaded), [](const StepRecord&, const DesignProgress&) {});
  EXPECT_EQ(rest.steps.size(), whole.steps.size());
  EXPECT_EQ(rest.best_density.cells.values, whole.best_density.cells.values);
  EXPECT_EQ(rest.stop_reason, whole.stop_reason);
  EXPECT_THROW(load_checkpoint(file, "another"), core::Error);
  std::filesystem::remove(file);
}

TEST(DesignLoop, StopsAtTheStartIfItIsEvenEnough) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("ratio", 0.9);
  spec.level = 0.1;
  EXPECT_EQ(designed(model, spec).steps.size(), 1U);
}

TEST(DesignLoop, MaxStepsEndsIt) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("ratio_noise_aware", 1e-9);
  spec.max_steps = 2;
  const DesignProgress progress = designed(model, spec);
  EXPECT_EQ(progress.steps.size(), 3U);
  EXPECT_EQ(progress.stop_reason.rfind("max_steps", 0), 0U);
}

}  // namespace
}  // namespace evenglow::design
