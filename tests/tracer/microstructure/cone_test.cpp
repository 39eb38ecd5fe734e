#include "tracer/microstructure/cone.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/flat_limit.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::ConicBump;
using tracer::RaySpan;

TEST(Cone, VanishingHeightIsTheFlatFace) {
  for (const std::string form : {"raised", "sunk"}) expect_flat_face("kind: cone, aspect: 0.001, form: " + form, 0.02);
}

TEST(Cone, SpanOfAStraightCone) {
  const ConicBump cone(45.0 * core::kRadPerDeg, 0.0);
  EXPECT_NEAR(cone.height(), 1.0, 1e-15);
  const RaySpan across = cone.span({-3.0, 0.0, 0.25}, Vec3::UnitX());
  EXPECT_NEAR(across.enter, 2.25, 1e-14);
  EXPECT_NEAR(across.leave, 3.75, 1e-14);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR((cone.normal(across.enter_face, {-0.75, 0.0, 0.25}) - Vec3(-r, 0.0, r)).norm(), 0.0, 1e-14);
  // Steeper than the flank: up and out through it, down and in; the nappe above the tip is not there.
  EXPECT_NEAR(cone.span({0.5, 0.0, 0.0}, Vec3::UnitZ()).leave, 0.5, 1e-14);
  const RaySpan down = cone.span({0.5, 0.0, 5.0}, -Vec3::UnitZ());
  EXPECT_NEAR(down.enter, 4.5, 1e-14);
  EXPECT_NEAR(down.leave, 5.0, 1e-14);
  EXPECT_EQ(down.leave_face, RaySpan::kFootprint);
  const RaySpan above = cone.span({-3.0, 0.0, 1.25}, Vec3::UnitX());
  EXPECT_GE(above.enter, above.leave);
  // Along a generator of the flank, inside: never out through it.
  const RaySpan along = cone.span({0.0, 0.0, 0.5}, Vec3(r, 0.0, -r));
  EXPECT_EQ(along.leave_face, RaySpan::kFootprint);
  // Beside the rim, upwards.
  const RaySpan rising = cone.span({-1.0, 0.0, 0.0}, Vec3(r, 0.0, r));
  EXPECT_GE(rising.enter, rising.leave - 1e-12);
}

TEST(Cone, TruncatedHasAFlatTop) {
  const ConicBump cone(std::atan(2.0), 0.4);
  EXPECT_NEAR(cone.height(), 1.2, 1e-15);
  const RaySpan axis = cone.span({0.3, 0.0, 0.1}, Vec3::UnitZ());
  EXPECT_NEAR(axis.leave, 1.1, 1e-15);
  EXPECT_EQ(cone.normal(axis.leave_face, {0.3, 0.0, 1.2}), Vec3::UnitZ());
  const RaySpan flank = cone.span({0.7, 0.0, 0.1}, Vec3::UnitZ());
  EXPECT_NEAR(flank.leave, 0.5, 1e-14);
  EXPECT_NEAR(cone.normal(flank.leave_face, {0.7, 0.0, 0.6}).x(), 2.0 / std::sqrt(5.0), 1e-15);
}

/// Inside and outside of many random lines agree with the definition of the body.
TEST(Cone, SpanHoldsThePointsOfTheBody) {
  core::PhotonRng rng({9, 0, 0}, 0);
  const auto symmetric = [&] { return 2.0 * rng.uniform() - 1.0; };
  for (const double flank_deg : {1.0, 30.0, 45.0, 60.0, 85.0}) {
    for (const double truncation : {0.0, 0.5}) {
      const double apex = std::tan(flank_deg * core::kRadPerDeg);
      const ConicBump cone(flank_deg * core::kRadPerDeg, truncation);
      for (int i = 0; i < 2000; ++i) {
        const Vec3 p(symmetric(), symmetric(), cone.height() * rng.uniform());
        const Vec3 k = Vec3(symmetric(), symmetric(), cone.height() * symmetric()).normalized();
        const RaySpan span = cone.span(p, k);
        for (const double t : {-0.4, -0.1, 0.0, 0.1, 0.4}) {
          const Vec3 q = p + t * k;
          const double slack = apex - q.z() - apex * std::hypot(q.x(), q.y());
          if (std::abs(slack) < 1e-9 * apex) continue;
          const bool in = slack > 0.0 && q.z() > 0.0 && q.z() < cone.height();
          EXPECT_EQ(in, t > span.enter && t < span.leave) << flank_deg << " " << truncation;
        }
      }
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
