#include "design/updaters/anderson_updater.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "tests/support/analytic_backlight.h"
#include "tests/support/coupled_backlight.h"

namespace evenglow::design {
namespace {

DesignSpec spec_of(const std::string& updater, double stop_rms) {
  DesignSpec spec;
  spec.updater = updater;
  spec.stop_rms = stop_rms;
  spec.density_min = 1e-4;
  spec.density_max = 0.95;
  spec.level = 0.1;
  spec.max_steps = 40;
  return spec;
}

DesignProgress designed(const ForwardModel& forward, const core::CellGrid& grid, const DesignSpec& spec) {
  const DesignLimits limits{100000, 16000000};
  return run_design(forward, spec, limits, start_design({core::CellField(grid, 0.1)}, spec, limits),
                    [](const StepRecord&, const DesignProgress&) {});
}

int steps_to(const DesignProgress& progress, double rms) {
  const auto there = std::find_if(progress.steps.begin(), progress.steps.end(),
                                  [&](const StepRecord& r) { return r.rms_corrected.value < rms; });
  return static_cast<int>(there - progress.steps.begin());
}

/// Each cell gets 1.5 times the mean from all others alike, whatever its own density: the ratio update leaves 1.5 / 2.5
/// of the error in each step, the acceleration finds the mode and takes it out.
TEST(AndersonUpdater, NeedsFewerStepsWhereCellsAreCoupled) {
  tests::AnalyticBacklight model;
  model.background = 1.5;
  model.noise = 1e-4;
  const ForwardModel forward = model;
  const DesignProgress plain = designed(forward, model.grid, spec_of("ratio_noise_aware", 0.002));
  const DesignProgress fast = designed(forward, model.grid, spec_of("anderson", 0.002));
  EXPECT_EQ(fast.stop_reason.rfind("reached", 0), 0U);
  EXPECT_LE(2 * steps_to(fast, 0.005), steps_to(plain, 0.005));
}

/// With noise as in a trace it must reach what the plain update reaches, in about the same number of steps.
TEST(AndersonUpdater, IsNotMisledByNoise) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    tests::CoupledBacklight model;
    model.seed = seed;
    const ForwardModel forward = model;
    const DesignProgress plain = designed(forward, model.grid, spec_of("ratio_noise_aware", 0.005));
    const DesignProgress fast = designed(forward, model.grid, spec_of("anderson", 0.005));
    EXPECT_LT(model.true_rms(fast.best_density.cells), 0.008) << seed;
    EXPECT_LE(fast.steps.size(), plain.steps.size() + 2) << seed;
  }
}

/// On a linear map x -> A x + b with two slow modes, two differences find the fixed point.
TEST(AndersonUpdater, SolvesALinearMapInAFewSteps) {
  const core::CellGrid grid = core::CellGrid::over(8, 1, 0, 0, 8, 1);
  DesignSpec spec;
  spec.density_min = 1e-6;
  UpdaterMemory memory;
  // Mode u contracts by 0.9 a step, mode v by 0.6; x = ln density is a u + b v about its mean.
  const std::vector<double> u = {1, 1, 1, 1, -1, -1, -1, -1}, v = {1, -1, 1, -1, 1, -1, 1, -1};
  double a = 0.2, b = -0.1;
  for (int step = 0; step < 4; ++step) {
    DesignState state{{core::CellField(grid, 0.1)}, {}};
    core::CellField residual(grid, 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
      state.density.cells.values[i] *= std::exp(a * u[i] + b * v[i]);
      residual.values[i] = -0.1 * a * u[i] - 0.4 * b * v[i];
    }
    state.record.rms_corrected.value = std::hypot(a, b);
    const core::CellField next = anderson_step(residual, 0.0, state, spec, true, memory);
    double along_u = 0.0, along_v = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
      along_u += next.values[i] * u[i] / 8.0;
      along_v += next.values[i] * v[i] / 8.0;
    }
    a += along_u;
    b += along_v;
  }
  EXPECT_LT(std::hypot(a, b), 1e-3);
}

}  // namespace
}  // namespace evenglow::design
