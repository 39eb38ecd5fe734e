#include "design/tolerance/map_sums.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/tolerance/distribution.h"

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0);

/// Cell 0 varies by 5 about 100, with a noise of 3; cell 1 is 50, with noise alone.
tracer::LuminanceMap map_of(int sample) {
  core::PhotonRng rng({3, 0, 0}, static_cast<std::uint64_t>(sample));
  tracer::LuminanceMap map{core::CellField(kGrid, 0.0), core::CellField(kGrid, 3.0)};
  map.luminance.values = {100.0 + 5.0 * draw_normal(rng) + 3.0 * draw_normal(rng), 50.0 + 3.0 * draw_normal(rng)};
  return map;
}

/// Deviations with the noise taken off; 20000 samples, bounds of about 5 standard errors.
TEST(MapSums, TakeTheNoiseOffEachCell) {
  MapSums sums;
  for (int i = 0; i < 20000; ++i) sums.add(map_of(i));
  const SpreadMaps maps = sums.maps(false);
  EXPECT_NEAR(maps.mean.values[0], 100.0, 0.25);
  EXPECT_NEAR(maps.deviation.values[0], 5.0, 0.2);
  EXPECT_LT(maps.deviation.values[1], 0.8);
  // Smoothed far beyond the two cells, both have the mean variance.
  EXPECT_NEAR(sums.maps(false, 50.0).deviation.values[1], 5.0 / std::sqrt(2.0), 0.2);
  EXPECT_NEAR(sums.maps(true).deviation.values[1], 3.0, 0.1) << "noise in common stays";
  // Of v / ((v + w) / 2) for v = 100, w = 50: 5 * 2 w / (v + w)^2.
  EXPECT_NEAR(maps.shape.values[0], 5.0 * 100.0 / 22500.0, 0.002);
}

TEST(MapSums, GoOnFromTheirNumbersToTheSameBits) {
  MapSums whole, first, second;
  for (int i = 0; i < 10; ++i) {
    whole.add(map_of(i));
    if (i < 4) first.add(map_of(i));
  }
  ASSERT_TRUE(second.restore(kGrid, first.count(), first.numbers()));
  for (int i = 4; i < 10; ++i) second.add(map_of(i));
  EXPECT_EQ(second.count(), 10U);
  EXPECT_EQ(second.maps(false).deviation.values, whole.maps(false).deviation.values);
  EXPECT_FALSE(second.restore(core::CellGrid::over(3, 1, 0, 0, 1, 1), 4, first.numbers()));
}

}  // namespace
}  // namespace evenglow::design
