#include "tracer/microstructure/pyramid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/flat_limit.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::RaySpan;
using tracer::SquarePyramid;

TEST(Pyramid, VanishingHeightIsTheFlatFace) {
  for (const std::string form : {"raised", "sunk"}) {
    expect_flat_face("kind: pyramid, aspect: 0.001, axis_deg: 33, form: " + form, 0.02);
  }
}

TEST(Pyramid, SpanAndFacets) {
  const SquarePyramid pyramid(45.0 * core::kRadPerDeg, 0.0);
  EXPECT_NEAR(pyramid.height(), 1.0, 1e-15);
  const RaySpan up = pyramid.span({0.2, -0.7, 0.0}, Vec3::UnitZ());
  EXPECT_NEAR(up.leave, 0.3, 1e-14);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR((pyramid.normal(up.leave_face, {}) - Vec3(0.0, -r, r)).norm(), 0.0, 1e-15);
  EXPECT_EQ(SquarePyramid(45.0 * core::kRadPerDeg, 0.5).span({0.2, -0.1, 0.0}, Vec3::UnitZ()).leave_face, 5);
}

TEST(Pyramid, NextCellIsThatOfThePattern) {
  const SquarePyramid pyramid(45.0 * core::kRadPerDeg, 0.0);
  Vec3 p(0.9, 0.5, 0.4);
  pyramid.next_cell(p, Vec3(0.6, 0.0, -0.8));
  EXPECT_NEAR((p - Vec3(-1.0, 0.5, 0.4 - 0.8 / 6.0)).norm(), 0.0, 1e-12);
  p = Vec3(0.9, -0.95, 0.4);
  pyramid.next_cell(p, Vec3(0.6, -0.8, 0.0));
  EXPECT_NEAR((p - Vec3(0.9375, 1.0, 0.4)).norm(), 0.0, 1e-12);
}

/// Light along the normal is totally reflected by one 45 degree facet and the one across, and goes back as it came: a
/// mirror for U and V up to the phases of two total reflections.
TEST(Pyramid, RaisedAt45SendsNormalLightBack) {
  const auto pyramid = optics_of("kind: pyramid, flank_deg: 45", 1.5);
  core::PhotonRng rng({10, 0, 0}, 0);
  for (int i = 0; i < 5000; ++i) {
    const auto out = pyramid->sample(core::StokesVector::unpolarized(1.0, core::PolarizationFrame{}), rng);
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->light.frame.k.z(), -1.0, 1e-12);
  }
}

/// With the sides at an angle, the four directions of light that a normal ray takes turn with axis_deg.
TEST(Pyramid, AxisTurnsThePattern) {
  core::PhotonRng rng({11, 0, 0}, 0);
  const auto pyramid = optics_of("kind: pyramid, flank_deg: 10, axis_deg: 30, face: top", 1.5);
  for (int i = 0; i < 2000; ++i) {
    const auto out = pyramid->sample(core::StokesVector::unpolarized(1.0, core::PolarizationFrame{}), rng);
    const Vec3& k = out->light.frame.k;
    if (k.z() < 0.0) continue;
    const double azimuth = std::atan2(k.y(), k.x()) / core::kRadPerDeg;
    EXPECT_NEAR(std::remainder(azimuth - 30.0, 90.0), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace evenglow::tests
