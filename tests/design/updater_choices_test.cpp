#include <cmath>
#include <memory>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/updaters/anderson_updater.h"
#include "design/updaters/auto_updater.h"
#include "design/updaters/path_reuse_updater.h"
#include "design/updaters/spline_updater.h"
#include "design/updaters/stochastic_approximation_updater.h"
#include "tracer/transport/arrival_records.h"

/// What updaters make of a made row of steps, without a model.
namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(8, 4, 0, 0, 8, 4);

/// A step with this RMS (known to 0.001), its luminance a slope whose two batches differ by `noise` times another
/// slope.
DesignState step_of(double rms, double noise = 0.0, double slope = 0.1) {
  DesignState state;
  state.density.cells = {kGrid, 0.2};
  state.observation.map = {{kGrid, 0.0}, {kGrid, 0.0}};
  std::vector<double> even, odd;
  for (int i = 0; i < 32; ++i) {
    const double x = (i % 8 - 3.5) / 3.5;
    const double luminance = std::exp(slope * x);
    even.push_back(luminance * (1.0 + noise * x));
    odd.push_back(luminance * (1.0 - noise * x));
    state.observation.map.luminance.values[static_cast<std::size_t>(i)] = 2.0 * luminance;
  }
  state.observation.luminance = core::Tally(32);
  state.observation.luminance.add_batch(even);
  state.observation.luminance.add_batch(odd);
  state.record.rms_corrected = {rms, 0.001};
  return state;
}

/// The method of the last of these steps.
std::string last_method(const std::vector<DesignState>& steps) {
  const auto updater = make_auto_updater();
  UpdaterMemory memory;
  std::string method;
  for (const DesignState& step : steps) method = updater->propose(step, DesignSpec{}, memory).method;
  return method;
}

TEST(AutoUpdaterChoice, AcceleratesWhereTheRmsFallsSlowly) {
  EXPECT_EQ(last_method({step_of(0.2)}), "ratio_noise_aware");
  EXPECT_EQ(last_method({step_of(0.2), step_of(0.15)}), "anderson");
  EXPECT_EQ(last_method({step_of(0.2), step_of(0.05)}), "ratio_noise_aware") << "fast enough";
  EXPECT_EQ(last_method({step_of(0.6), step_of(0.5)}), "ratio_noise_aware") << "far from the end";
}

TEST(AutoUpdaterChoice, DoesNotTakeNoiseForCoupling) {
  EXPECT_EQ(last_method({step_of(0.2, 0.3, 0.6), step_of(0.15, 0.3, 0.6)}), "ratio_noise_aware");
}

TEST(AutoUpdaterChoice, GivesUpWhereTheRmsRisesAndForGoodTheSecondTime) {
  EXPECT_EQ(last_method({step_of(0.2), step_of(0.15), step_of(0.2)}), "ratio_noise_aware");
  EXPECT_EQ(last_method({step_of(0.2), step_of(0.15), step_of(0.2), step_of(0.18)}), "anderson");
  EXPECT_EQ(last_method({step_of(0.2), step_of(0.15), step_of(0.2), step_of(0.18), step_of(0.25), step_of(0.2)}),
            "ratio_noise_aware");
}

/// The free cells of the second step, the residual of the cell at its limit being `held` in it.
std::vector<double> accelerated(double held) {
  const core::CellGrid grid = core::CellGrid::over(4, 1, 0, 0, 4, 1);
  DesignSpec spec;
  DesignState state;
  state.density.cells = {grid, 0.2};
  state.density.cells.values = {0.2, 0.3, 0.25, spec.density_max};
  state.record.rms_corrected = {0.1, 0.001};
  core::CellField residual(grid, 0.0);
  residual.values = {0.2, -0.1, 0.05, 0.1};
  UpdaterMemory memory;
  anderson_step(residual, 0.0, state, spec, true, memory);
  state.density.cells.values = {0.22, 0.28, 0.26, spec.density_max};
  residual.values = {0.12, -0.05, 0.01, held};
  std::vector<double> step = anderson_step(residual, 0.0, state, spec, true, memory).values;
  step.pop_back();
  return step;
}

TEST(AndersonChoice, CellsAtALimitHaveNoSayInTheCoefficients) {
  const std::vector<double> one = accelerated(0.1), other = accelerated(-0.2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-9);
  EXPECT_GT(std::abs(one[0] - 0.12), 1e-3) << "it is accelerated";
}

TEST(StochasticApproximationChoice, ACellWhoseErrorChangesItsSignTakesShorterSteps) {
  const auto updater = make_stochastic_approximation_updater();
  UpdaterMemory memory;
  const auto contrast = [&](double slope) {
    const auto density = updater->propose(step_of(0.1, 0.0, slope), DesignSpec{}, memory).density.cells.values;
    return std::log(density[7] / density[0]);
  };
  EXPECT_NEAR(contrast(0.1), -0.2, 1e-9);
  EXPECT_NEAR(contrast(0.1), -0.2, 1e-9) << "the same sign";
  EXPECT_NEAR(contrast(-0.1), 0.1, 1e-9) << "half a step";
  EXPECT_NEAR(contrast(0.1), -0.2 / 3.0, 1e-9);
}

TEST(SplineChoice, ASearchThatHasEndedStaysAtItsBestPoint) {
  DesignSpec spec;
  spec.spline.nx = 2;
  spec.spline.ny = 1;
  spec.spline.method = "sbplx";
  const auto updater = make_spline_updater();
  UpdaterMemory memory;
  DesignState state = step_of(0.0);
  double contrast = 0.0;
  for (int step = 0; step < 400; ++step) {
    state.record.rms_corrected = {std::pow(contrast - 0.5, 2), 0.001};
    state.density = updater->propose(state, spec, memory).density;
    contrast = std::log(state.density.cells.values[7] / state.density.cells.values[0]);
  }
  EXPECT_NEAR(contrast, 0.5, 0.02);
}

TEST(SplineChoice, FourCoefficientsMakeACubic) {
  const core::CellField field = spline_field(core::CellGrid::over(10, 1, 0, 0, 10, 1), 4, 1, {0.0, 0.0, 0.0, 1.0});
  for (int i = 0; i < 10; ++i) {
    const double u = (i + 0.5) / 10.0;
    EXPECT_NEAR(field.values[static_cast<std::size_t>(i)], u * u * u, 1e-12);
  }
}

/// Records of photons that meet each cell many times: a few steps, and hardly any of them counts.
TEST(PathReuseChoice, EndsWhereTheHistoriesAreWorthNoMore) {
  DesignState state = step_of(0.2, 0.0, 1.0);
  std::mt19937 random(1);
  std::vector<tracer::ArrivalLog> logs;
  core::Tally luminance(32);
  for (int batch = 0; batch < 10; ++batch) {
    tracer::ArrivalLog log(std::size_t{1} << 22);
    std::vector<double> sums(32, 0.0);
    for (int photon = 0; photon < 200; ++photon) {
      std::size_t cell = 0;
      for (int arrival = 0; arrival < 60; ++arrival) {
        cell = random() % 32;
        log.arrival(cell, random() % 5 == 0);
      }
      const double amount = std::exp(static_cast<double>(cell % 8) / 3.0);
      log.deposit(cell, amount);
      sums[cell] += amount;
      log.end_photon();
    }
    logs.push_back(std::move(log));
    luminance.add_batch(std::move(sums));
  }
  state.observation.luminance = luminance;
  const std::vector<core::Estimate> totals = luminance.totals();
  for (std::size_t i = 0; i < 32; ++i) state.observation.map.luminance.values[i] = totals[i].value;
  state.recorded = {
      {std::make_shared<tracer::ArrivalRecords>(state.density, 32, 1, std::move(logs)), luminance, 2000, 0}};
  DesignSpec spec;
  spec.level = 0.25;
  const Proposal proposal = reuse_paths(state, spec);
  EXPECT_THAT(proposal.note, ::testing::HasSubstr("the histories are worth no more there"));
  EXPECT_NEAR(proposal.level_change, 1.25, 1e-3);
}

}  // namespace
}  // namespace evenglow::design
