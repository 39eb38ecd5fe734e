#include "tracer/microstructure/round_cell.h"

#include <gtest/gtest.h>

#include "tracer/microstructure/microlens.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::RoundCell;
using tracer::SphericalCap;

/// Filled: out at one end of the chord, in at the other, with the height of the way between; reversed, the same way.
TEST(RoundCell, ChordIsLeftAndEnteredAtItsEnds) {
  const SphericalCap half_sphere(0.5);
  const RoundCell cell(1.0);
  const Vec3 k(0.6, 0.0, 0.8);
  Vec3 p(0.2, 0.6, 0.1);
  EXPECT_NEAR(cell.way_to_wall(p, k), 1.0, 1e-14);  // to x = 0.8
  cell.next_cell(p, k, half_sphere);
  EXPECT_NEAR((p - Vec3(-0.8, 0.6, 0.9)).norm(), 0.0, 1e-14);
  EXPECT_TRUE(cell.covers(p));
  EXPECT_TRUE(cell.clears(p, k, half_sphere));  // the chord's top is 0.8
  p.z() = 0.79;
  EXPECT_FALSE(cell.clears(p, k, half_sphere));
}

/// From high above a chord, down by whole chords to the last one over the bump's top.
TEST(RoundCell, FallsByWholeChords) {
  const SphericalCap half_sphere(0.5);
  const RoundCell cell(1.0);
  const double slope = 1e-4;
  const Vec3 k = Vec3(1.0, 0.0, -slope).normalized();
  Vec3 p(-0.8, 0.6, 1.0);
  cell.next_cell(p, k, half_sphere);
  EXPECT_GE(p.z(), 0.8);
  EXPECT_LT(p.z(), 0.8 + 1.6 * slope);
  EXPECT_NEAR(std::remainder(1.0 - p.z(), 1.6 * slope), 0.0, 1e-12);
  EXPECT_NEAR(p.x(), -0.8, 1e-14);
}

/// Less filled: a square of the area pi / fill, with bare face around the footprint.
TEST(RoundCell, SquareAroundTheFootprint) {
  const SphericalCap half_sphere(0.5);
  const RoundCell cell(0.25);
  const double half = std::sqrt(core::kPi);  // (2 half)^2 = pi / 0.25
  Vec3 p(0.0, 0.5, 0.5);
  EXPECT_NEAR(cell.way_to_wall(p, Vec3::UnitX()), half, 1e-14);
  cell.next_cell(p, Vec3::UnitX(), half_sphere);
  EXPECT_NEAR((p - Vec3(-half, 0.5, 0.5)).norm(), 0.0, 1e-14);
  EXPECT_FALSE(cell.covers(p));
  core::PhotonRng rng({1, 0, 0}, 0);
  int covered = 0;
  for (int i = 0; i < 40000; ++i) covered += cell.covers(cell.point(rng)) ? 1 : 0;
  EXPECT_NEAR(covered / 40000.0, 0.25, 4.0 * std::sqrt(0.25 * 0.75 / 40000.0));  // false alarm 6e-5
}

}  // namespace
}  // namespace evenglow::tests
