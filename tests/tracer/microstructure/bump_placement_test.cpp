#include "tracer/microstructure/bump_placement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::BumpPlacement;

/// Local axes of the plate's faces, as the scene lays them: x along the plate's x, y = normal x x.
Vec3 to_face(const Vec3& v, bool top) {
  const Vec3 normal = top ? Vec3::UnitZ() : Vec3(-Vec3::UnitZ());
  return {v.x(), normal.cross(Vec3::UnitX()).dot(v), normal.dot(v)};
}

TEST(BumpPlacement, TurnsAndBackWithoutMirror) {
  for (const auto form : {BumpPlacement::Form::kRaised, BumpPlacement::Form::kSunk}) {
    for (const bool top : {false, true}) {
      const BumpPlacement placement(form, 0.7, top);
      const Vec3 a(0.1, 0.5, -0.8), b(-0.4, 0.2, 0.3);
      EXPECT_NEAR((placement.out_of_bump(placement.into_bump(a)) - a).norm(), 0.0, 1e-15);
      EXPECT_NEAR((placement.into_bump(a.cross(b)) - placement.into_bump(a).cross(placement.into_bump(b))).norm(), 0.0,
                  1e-15);
      EXPECT_EQ(placement.sunk(), form == BumpPlacement::Form::kSunk);
      EXPECT_EQ(placement.into_bump(Vec3::UnitZ()).z(), placement.sunk() ? -1.0 : 1.0);
    }
  }
}

/// The ridge lies along axis_deg, from the plate's +x towards its +y, on both faces; x across it, turned back by 90.
TEST(BumpPlacement, AxisCountsInTheBacklight) {
  for (const auto form : {BumpPlacement::Form::kRaised, BumpPlacement::Form::kSunk}) {
    for (const bool top : {false, true}) {
      for (const double degrees : {0.0, 30.0, 90.0, 140.0}) {
        const double axis = degrees * core::kRadPerDeg;
        const BumpPlacement placement(form, axis, top);
        const Vec3 ridge = placement.into_bump(to_face({std::cos(axis), std::sin(axis), 0.0}, top));
        const Vec3 across = placement.into_bump(to_face({std::sin(axis), -std::cos(axis), 0.0}, top));
        EXPECT_NEAR(std::abs(ridge.y()), 1.0, 1e-15);
        EXPECT_NEAR(across.x(), 1.0, 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
