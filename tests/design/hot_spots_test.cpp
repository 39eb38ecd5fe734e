#include "design/problem/hot_spots.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// Three LEDs of 2 mm at 3, 8 and 13 mm along an edge of 16 mm; cells of 0.5 mm along it, 1 mm away from it.
const std::vector<LedWindow> kLeds = {{2.0, 4.0}, {7.0, 9.0}, {12.0, 14.0}};
const core::CellGrid kCells = core::CellGrid::over(10, 32, 0.0, 0.0, 10.0, 16.0);

/// 1 between the LEDs and 1 + excess / (1 + distance)^4 in front of them; a slope along the edge on top.
double luminance(double distance, double along, double slope) {
  double value = 1.0;
  for (const LedWindow& led : kLeds) {
    if (along > led.min && along < led.max) value += 8.0 / std::pow(1.0 + distance, 4);
  }
  return value * (1.0 + slope * (along - 8.0));
}

core::Tally tally_of(const core::CellGrid& g, bool along_y, bool upper, double slope, double noise, int batches,
                     std::mt19937_64& random) {
  core::Tally tally(g.size());
  std::normal_distribution<double> normal;
  for (int b = 0; b < batches; ++b) {
    std::vector<double> sums;
    for (int iy = 0; iy < g.ny; ++iy) {
      for (int ix = 0; ix < g.nx; ++ix) {
        const double across = along_y ? g.center_x(ix) : g.center_y(iy);
        const double along = along_y ? g.center_y(iy) : g.center_x(ix);
        sums.push_back(luminance(upper ? 10.0 - across : across, along, slope) * (1.0 + noise * normal(random)));
      }
    }
    tally.add_batch(std::move(sums));
  }
  return tally;
}

TEST(HotSpots, RatioByDistanceAtEveryEdge) {
  std::mt19937_64 random(1);
  for (const bool along_y : {true, false}) {
    for (const bool upper : {true, false}) {
      const core::CellGrid g = along_y ? kCells : core::CellGrid::over(32, 10, 0.0, 0.0, 16.0, 10.0);
      const auto found = hot_spots({2, "edge", along_y, upper ? 10.0 : 0.0, kLeds}, g,
                                   tally_of(g, along_y, upper, 0.0, 0.0, 10, random), 3.0);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->source, 2U);
      EXPECT_EQ(found->gaps, 2);
      EXPECT_DOUBLE_EQ(found->led_width, 2.0);
      EXPECT_DOUBLE_EQ(found->gap_width, 3.0);
      ASSERT_EQ(found->lines.size(), 10U);
      for (std::size_t i = 0; i < 10; ++i) {
        const HotSpotLine& line = found->lines[i];
        const double distance = 0.5 + static_cast<double>(i);
        EXPECT_NEAR(line.distance, distance, 1e-12);
        EXPECT_NEAR(line.ratio.value, 1.0 + 8.0 / std::pow(1.0 + distance, 4), 1e-12);
        EXPECT_NEAR(line.between.value, 10.0 * 3.0, 1e-9);
        EXPECT_NEAR(line.front.value, 30.0 * line.ratio.value, 1e-9);
        EXPECT_NEAR(line.ratio.se, 0.0, 1e-12);
      }
      // 8 / (1 + d)^4 = 0.02 at d = 3.47: the line at 3.5 mm no longer shows, that at 2.5 mm does.
      ASSERT_TRUE(found->mixing_distance);
      EXPECT_NEAR(*found->mixing_distance, 3.0, 1e-12);
    }
  }
}

TEST(HotSpots, ASlopeAlongTheEdgeDropsOut) {
  std::mt19937_64 random(1);
  const auto found =
      hot_spots({0, "left", true, 0.0, kLeds}, kCells, tally_of(kCells, true, false, 0.05, 0.0, 10, random), 1.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lines.back().ratio.value, 1.0 + 8.0 / std::pow(10.5, 4), 1e-9);
}

/// Cells that lie in part in front of an LED count by that part.
TEST(HotSpots, CellsCountByTheirShare) {
  const core::CellGrid g = core::CellGrid::over(1, 8, 0.0, 0.0, 1.0, 16.0);  // cells of 2 mm
  core::Tally tally(8);
  for (int b = 0; b < 3; ++b) tally.add_batch({1, 3, 0, 5, 0, 0, 0, 0});
  // LED 1 over 1 ... 3: half of cells 0 and 1; LED 2 over 6 ... 8: cell 3. The gap 3 ... 6, its middle 3.5 ... 5.5.
  const auto found = hot_spots({0, "left", true, 0.0, {{1.0, 3.0}, {6.0, 8.0}}}, g, tally, 1.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lines[0].front.value, 3.0 * 0.5 * (2.0 + 5.0), 1e-12);
  EXPECT_NEAR(found->lines[0].between.value, 3.0 * 0.25 * 3.0, 1e-12);
}

TEST(HotSpots, NeedTwoLedsBeforeTheDisplay) {
  std::mt19937_64 random(1);
  const core::Tally tally = tally_of(kCells, true, false, 0.0, 0.0, 10, random);
  EXPECT_FALSE(hot_spots({0, "left", true, 0.0, {kLeds[0]}}, kCells, tally, 1.0));
  EXPECT_FALSE(hot_spots({0, "left", true, 0.0, {{1.0, 3.0}, {3.0, 5.0}}}, kCells, tally, 1.0));  // no gap
  const auto some = hot_spots({0, "left", true, 0.0, {{-1.0, 1.0}, kLeds[1], kLeds[2]}}, kCells, tally, 1.0);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->gaps, 1);  // the first LED stands beside the display
}

/// 400 repetitions of the first and the last line: the width of the pulls has a standard error of 0.035; 0.12 is more
/// than 3 (false alarm 1e-3 each).
TEST(HotSpots, PullsOfTheRatioHaveUnitWidth) {
  std::mt19937_64 random(4);
  double sum[2] = {}, squares[2] = {};
  for (int i = 0; i < 400; ++i) {
    const auto found =
        hot_spots({0, "left", true, 0.0, kLeds}, kCells, tally_of(kCells, true, false, 0.0, 0.1, 50, random), 1.0);
    const HotSpotLine* lines[2] = {&found->lines.front(), &found->lines.back()};
    for (int k = 0; k < 2; ++k) {
      const double expected = 1.0 + 8.0 / std::pow(1.0 + lines[k]->distance, 4);
      const double pull = (lines[k]->ratio.value - expected) / lines[k]->ratio.se;
      sum[k] += pull / 400.0;
      squares[k] += pull * pull / 400.0;
    }
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::sqrt(squares[k] - sum[k] * sum[k]), 1.0, 0.12);
    EXPECT_LT(std::abs(sum[k]), 0.2);
  }
}

/// Cells of 8 mm hold an LED and a gap alike: nothing can be said of them.
TEST(HotSpots, NoneWhereCellsAreTooCoarse) {
  std::mt19937_64 random(1);
  const core::CellGrid coarse = core::CellGrid::over(10, 2, 0.0, 0.0, 10.0, 16.0);
  const LedEdge edge{0, "left", true, 0.0, kLeds};
  EXPECT_FALSE(hot_spots(edge, coarse, tally_of(coarse, true, false, 0.0, 0.0, 4, random), 1.0));
  EXPECT_TRUE(hot_spots(edge, kCells, tally_of(kCells, true, false, 0.0, 0.0, 4, random), 1.0));
}

TEST(HotSpots, NoneWithoutLight) {
  core::Tally dark(kCells.size());
  for (int b = 0; b < 4; ++b) dark.add_batch(std::vector<double>(kCells.size(), 0.0));
  EXPECT_FALSE(hot_spots({0, "left", true, 0.0, kLeds}, kCells, dark, 1.0));
}

}  // namespace
}  // namespace evenglow::design
