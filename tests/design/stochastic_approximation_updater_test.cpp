#include "design/updaters/stochastic_approximation_updater.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// Two cells whose luminance is told step by step.
DesignState state_of(const std::vector<double>& density, const std::vector<double>& luminance) {
  const core::CellGrid grid = core::CellGrid::over(2, 1, 0, 0, 2, 1);
  DesignState state{{core::CellField(grid, 0.0)}, {}};
  state.density.cells.values = density;
  state.observation.map = {{grid, 0.0}, {grid, 0.0}};
  state.observation.map.luminance.values = luminance;
  return state;
}

TEST(StochasticApproximation, GainsFallOnlyWithChangesOfSign) {
  const auto updater = make_stochastic_approximation_updater();
  DesignSpec spec;
  spec.density_min = 1e-4;
  UpdaterMemory memory;
  const auto ratio_after = [&](double left, double right) {
    const Proposal p = updater->propose(state_of({0.1, 0.1}, {left, right}), spec, memory);
    return std::log(p.density.cells.values[0] / p.density.cells.values[1]);
  };
  const double whole = std::log(0.9 / 1.1);
  EXPECT_NEAR(ratio_after(1.1, 0.9), whole, 1e-12);
  EXPECT_NEAR(ratio_after(1.1, 0.9), whole, 1e-12) << "the same sign: the gain stays";
  EXPECT_NEAR(ratio_after(0.9, 1.1), -whole / 2.0, 1e-12) << "one change: half";
  EXPECT_NEAR(ratio_after(0.9, 1.1), -whole / 2.0, 1e-12);
  EXPECT_NEAR(ratio_after(1.1, 0.9), whole / 3.0, 1e-12) << "two changes: a third";
}

}  // namespace
}  // namespace evenglow::design
