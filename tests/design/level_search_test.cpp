#include "design/engine/level_search.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

tracer::DensityField flat(double density) {
  return {core::CellField(core::CellGrid::over(4, 2, 0, 0, 4, 2), density)};
}

/// Efficiency 0.7 (1 - exp(-level / scale)): grows with the level and saturates.
ForwardModel saturating(double scale) {
  return [scale](const tracer::DensityField& density, std::uint64_t, std::uint32_t) {
    Observation observation;
    observation.efficiency = {0.7 * (1.0 - std::exp(-density.cells.mean() / scale)), 1e-4};
    return std::optional<Observation>(observation);
  };
}

TEST(LevelSearch, TakesTheLowestLevelWithinTwoPercentOfTheBest) {
  const DesignSpec spec;
  // Saturated everywhere: the lowest candidate. Far from saturation: the highest.
  EXPECT_DOUBLE_EQ(choose_level(saturating(0.005), flat(0.1), spec, 1000)->factor, 0.4);
  EXPECT_DOUBLE_EQ(choose_level(saturating(1.0), flat(0.1), spec, 1000)->factor, 2.5);
  // 1 - exp(-0.16 / 0.04) = 0.982 of the limit, 1 - exp(-0.1 / 0.04) = 0.918.
  EXPECT_DOUBLE_EQ(choose_level(saturating(0.04), flat(0.1), spec, 1000)->factor, 1.6);
}

TEST(LevelSearch, LeavesRoomToTheUpperLimit) {
  DesignSpec spec;
  spec.density_max = 0.3;
  // 2.5 x 0.1 is above three quarters of 0.3.
  EXPECT_DOUBLE_EQ(choose_level(saturating(1.0), flat(0.1), spec, 1000)->factor, 1.6);
}

TEST(LevelSearch, IsEmptyWhenInterrupted) {
  const ForwardModel interrupted = [](const tracer::DensityField&, std::uint64_t, std::uint32_t) {
    return std::optional<Observation>();
  };
  EXPECT_FALSE(choose_level(interrupted, flat(0.1), DesignSpec{}, 1000).has_value());
}

}  // namespace
}  // namespace evenglow::design
