#include "design/updaters/log_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/problem/design_spec.h"

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(4, 1, 0, 0, 4, 1);

/// Four cells of this luminance and a density of 0.2.
DesignState state_of(const std::vector<double>& luminance) {
  DesignState state;
  state.density.cells = {kGrid, 0.2};
  state.observation.map = {{kGrid, 0.0}, {kGrid, 0.0}};
  state.observation.map.luminance.values = luminance;
  return state;
}

TEST(LogStep, TheExcessIsThatOverTheMean) {
  const core::CellField excess = log_excess(state_of({100.0, 100.0, 50.0, 150.0}));
  EXPECT_NEAR(excess.values[0], 0.0, 1e-15);
  EXPECT_NEAR(excess.values[2], std::log(0.5), 1e-15);
  EXPECT_NEAR(excess.values[3], std::log(1.5), 1e-15);
  EXPECT_DOUBLE_EQ(log_excess(state_of({0.0, 1.0, 1.0, 2.0})).values[0], std::log(1e-6));
}

TEST(LogStep, ABrightCellLosesAndNoStepIsLargerThanAFactorOfFour) {
  const DesignState state = state_of({100.0, 100.0, 50.0, 150.0});
  DesignSpec spec;
  spec.power = 0.5;
  core::CellField excess(kGrid, 0.0);
  excess.values = {0.2, -0.2, -100.0, 100.0};
  const core::CellField step = ratio_step(state, spec, excess);
  EXPECT_DOUBLE_EQ(step.values[0], -0.1);
  EXPECT_DOUBLE_EQ(step.values[1], 0.1);
  EXPECT_DOUBLE_EQ(step.values[2], std::log(4.0));
  EXPECT_DOUBLE_EQ(step.values[3], -std::log(4.0));
}

TEST(LogStep, TheDensityIsTakenTimesTheExponentialOfTheStep) {
  const DesignState state = state_of({1.0, 1.0, 1.0, 1.0});
  core::CellField step(kGrid, 0.0);
  step.values = {0.3, -0.3, 0.0, 9.0};
  const Proposal proposal = take_step(state, DesignSpec{}, step);
  const auto& density = proposal.density.cells.values;
  EXPECT_NEAR(density[0] / density[2], std::exp(0.3), 1e-12);
  EXPECT_NEAR(density[1] / density[2], std::exp(-0.3), 1e-12);
  EXPECT_NEAR(density[3] / density[2], 4.0, 1e-12);
}

}  // namespace
}  // namespace evenglow::design
