#include "design/engine/design_loop.h"

#include <gtest/gtest.h>

#include "design/engine/checkpoint.h"
#include "design/problem/target.h"
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

/// The same of the first `columns` columns alone.
double masked_rms(const tests::AnalyticBacklight& model, const tracer::DensityField& density, int columns) {
  const auto L = model.luminance(density);
  double mean = 0.0, squares = 0.0, count = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < L.size(); ++i) {
      if (static_cast<int>(i) % model.grid.nx >= columns) continue;
      (pass == 0 ? mean : squares) += pass == 0 ? L[i] : (L[i] - mean) * (L[i] - mean);
      count += pass == 0 ? 1.0 : 0.0;
    }
    if (pass == 0) mean /= count;
  }
  return std::sqrt(squares / count) / mean;
}

// Outcomes, not densities: every updater must reach the wanted evenness of the noise-free model, from an uneven start.
TEST(DesignLoop, EveryUpdaterReachesTheWantedEvenness) {
  const tests::AnalyticBacklight model;
  for (const UpdaterEntry& entry : updater_registry()) {
    if (entry.name == "spline") continue;  // a smooth profile cannot follow this model's rows: spline_updater_test.cpp
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

TEST(DesignLoop, FreeLevelGoesToTheKneeOfTheEfficiency) {
  const tests::AnalyticBacklight model;
  const DesignSpec spec = spec_of("ratio_noise_aware", 0.01);
  const DesignProgress progress = designed(model, spec);
  EXPECT_NE(progress.level_note.find("chosen"), std::string::npos);
  // Efficiency grows with the level in this model and far from saturation: the level must have gone up.
  EXPECT_GT(progress.best_density.cells.mean(), 0.13);
}

/// Every updater, with all that it remembers, from a design that was interrupted after three steps.
class DesignLoopOf : public testing::TestWithParam<std::string> {};

TEST_P(DesignLoopOf, GoesOnFromACheckpointToTheSameBits) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of(GetParam(), 0.002);
  spec.max_steps = 8;
  const DesignLimits limits{200000, 16000000};
  const auto file = std::filesystem::path(testing::TempDir()) / ("evenglow_design_loop_" + GetParam() + ".json");
  std::filesystem::remove(file);
  const DesignProgress whole = designed(model, spec, limits);
  ASSERT_GT(whole.steps.size(), 4U);
  int left = 4;
  const ForwardModel interrupted = [&](const auto& density, auto photons, auto step) {
    return step < 0x80000000U && left-- <= 0 ? std::nullopt : model(density, photons, step);
  };
  const DesignProgress part =
      run_design(interrupted, spec, limits, start_design(flat(model.grid, 0.1), spec, limits),
                 [&](const StepRecord&, const DesignProgress& p) { save_checkpoint(file, "me", p); });
  EXPECT_TRUE(part.stop_reason.empty());
  auto loaded = load_checkpoint(file, "me");
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->steps.size(), 4U);
  const DesignProgress rest =
      run_design(model, spec, limits, std::move(*loaded), [](const StepRecord&, const DesignProgress&) {});
  EXPECT_EQ(rest.steps.size(), whole.steps.size());
  EXPECT_EQ(rest.density.cells.values, whole.density.cells.values);
  EXPECT_EQ(rest.best_density.cells.values, whole.best_density.cells.values);
  EXPECT_EQ(rest.memory, whole.memory);
  EXPECT_EQ(rest.notes, whole.notes);
  EXPECT_EQ(rest.stop_reason, whole.stop_reason);
  EXPECT_THROW(load_checkpoint(file, "another"), core::Error);
  std::filesystem::remove(file);
}

std::vector<std::string> updater_names() {
  std::vector<std::string> names;
  for (const UpdaterEntry& entry : updater_registry()) names.push_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Updaters, DesignLoopOf, testing::ValuesIn(updater_names()),
                         [](const auto& name) { return name.param; });

/// A state may come from anyone: lists of other lengths than an updater writes count as forgotten.
TEST(DesignLoop, AMemoryOfOtherSizesIsForgotten) {
  const tests::AnalyticBacklight model;
  const std::vector<std::pair<std::string, std::vector<std::string>>> updaters = {
      {"anderson", {"anderson.x", "anderson.f"}}, {"spline", {"spline.base"}}};
  for (const auto& [updater, lists] : updaters) {
    DesignSpec spec = spec_of(updater, 1e-6);
    spec.level = 0.1;
    const DesignLimits limits{200000, 16000000};
    const auto after = [&](DesignProgress progress, int steps) {
      int left = steps;
      const ForwardModel some = [&](const auto& density, auto photons, auto step) {
        return left-- <= 0 ? std::nullopt : model(density, photons, step);
      };
      return run_design(some, spec, limits, std::move(progress), [](const StepRecord&, const DesignProgress&) {});
    };
    const DesignProgress part = after(start_design(flat(model.grid, 0.1), spec, limits), 4);
    ASSERT_EQ(part.steps.size(), 4U);
    DesignProgress forged = part, forgotten = part;
    for (const std::string& list : lists) {
      ASSERT_FALSE(part.memory.at(list).empty());
      forgotten.memory.erase(list);
    }
    std::vector<double>& longer = forged.memory[lists.front()];
    longer.insert(longer.end(), part.density.cells.values.begin(), part.density.cells.values.end());
    EXPECT_EQ(after(std::move(forged), 1).density.cells.values, after(std::move(forgotten), 1).density.cells.values)
        << updater;
  }
}

TEST(DesignLoop, RecordsTheNoiseAndWhatWasSpentOnTheLevel) {
  const tests::AnalyticBacklight model;
  const DesignProgress progress = designed(model, spec_of("ratio_noise_aware", 0.01));
  std::uint64_t spent = 0;
  for (const StepRecord& record : progress.steps) {
    // 20 batches of Gaussian noise; the figure comes from a single trace of 288 cells: within 10 %.
    const double noise = model.noise * std::sqrt(1e6 / static_cast<double>(record.photons));
    EXPECT_NEAR(record.noise, noise, 0.1 * noise);
    EXPECT_EQ(record.updater, "ratio_noise_aware");
    spent += record.level_photons;
  }
  EXPECT_GE(spent, 6U * 200000U);
}

TEST(DesignLoop, MeetsATargetThatIsNotUniform) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("auto", 0.01);
  spec.target.kind = "center_weighted";
  spec.target.corner = 0.6;
  const DesignProgress progress = designed(model, spec);
  const core::CellField wanted = target_shape(spec.target, model.grid);
  std::vector<double> L = model.luminance(progress.best_density);
  double mean = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < L.size(); ++i) mean += (L[i] /= wanted.values[i]) / static_cast<double>(L.size());
  for (const double v : L) squares += (v / mean - 1.0) * (v / mean - 1.0) / static_cast<double>(L.size());
  EXPECT_LT(std::sqrt(squares), 0.012);
  EXPECT_GT(true_rms(model, progress.best_density), 0.05);
}

TEST(DesignLoop, LeavesMaskedCellsOutOfTheJudgment) {
  // Far from the LEDs the upper limit leaves the plate too dark; a mask over the last quarter leaves that out.
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("ratio_noise_aware", 0.01);
  spec.level = 0.15;
  spec.density_max = 0.2;
  spec.max_steps = 8;
  const DesignProgress whole = designed(model, spec);
  EXPECT_GT(whole.best_rms, 0.03);
  spec.mask = {4, 1, {1.0, 1.0, 1.0, 0.0}};
  const DesignProgress part = designed(model, spec);
  EXPECT_LT(part.best_rms, whole.best_rms);
  EXPECT_NEAR(part.steps.front().rms_corrected.value, masked_rms(model, flat(model.grid, *spec.level), 18), 0.01);
}

TEST(DesignLoop, KeepsTheWantedEfficiencyOfMinRms) {
  const tests::AnalyticBacklight model;
  DesignSpec spec = spec_of("auto", 0.01);
  spec.goal.kind = "min_rms";
  spec.goal.efficiency = 0.55;
  const DesignProgress progress = designed(model, spec);
  EXPECT_NE(progress.level_note.find("reaches 55.0 %"), std::string::npos) << progress.level_note;
  const auto judged = model(progress.best_density, 16000000, 77);
  EXPECT_NEAR(judged->efficiency.value, 0.55, 0.01);
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
