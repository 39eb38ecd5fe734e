#include "tracer/microstructure/microlens.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/light/fresnel.h"
#include "tests/support/flat_limit.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::RaySpan;
using tracer::SphericalCap;

TEST(Microlens, VanishingHeightIsTheFlatFace) {
  for (const std::string form : {"raised", "sunk"})
    expect_flat_face("kind: microlens, aspect: 0.0001, form: " + form, 0.01);
}

TEST(Microlens, SpanOfAHalfSphere) {
  const SphericalCap cap(0.5);
  EXPECT_EQ(cap.height(), 1.0);
  const RaySpan axis = cap.span({0.0, 0.0, 0.2}, Vec3::UnitZ());
  EXPECT_NEAR(axis.leave, 0.8, 1e-15);
  EXPECT_NEAR(axis.enter, -0.2, 1e-15);
  EXPECT_EQ(axis.enter_face, RaySpan::kFootprint);
  const RaySpan across = cap.span({-5.0, 0.0, 0.6}, Vec3::UnitX());
  EXPECT_NEAR(across.enter, 4.2, 1e-14);
  EXPECT_NEAR(across.leave, 5.8, 1e-14);
  EXPECT_NEAR((cap.normal(across.enter_face, {-0.8, 0.0, 0.6}) - Vec3(-0.8, 0.0, 0.6)).norm(), 0.0, 1e-15);
  const RaySpan above = cap.span({-5.0, 0.0, 1.1}, Vec3::UnitX());
  EXPECT_GE(above.enter, above.leave);
}

/// The rim, the tip and the slope at the rim of caps of all heights.
TEST(Microlens, CapsOfAllHeights) {
  for (const double aspect : {0.0001, 0.05, 0.2, 0.5}) {
    const SphericalCap cap(aspect);
    const double h = 2.0 * aspect;
    EXPECT_NEAR(cap.span({0.0, 0.0, 0.0}, Vec3::UnitZ()).leave, h, 1e-15);
    EXPECT_NEAR(cap.span({1.0 - 1e-9, 0.0, 0.0}, Vec3::UnitZ()).leave, 0.0, 1e-4);
    // The cap meets the face at twice the angle of its chord from rim to tip.
    EXPECT_NEAR(std::acos(cap.normal(1, {1.0, 0.0, 0.0}).z()), 2.0 * std::atan(h), 1e-7);
  }
}

/// Light that comes along the axis of the lens: the first refraction brings it to the focus of the surface. At odds: a
/// ray through the footprint at radius r leaves with sin of its angle from Snell's law at the tilt asin(r / R).
TEST(Microlens, BendsNormalLightByTheTiltOfItsSurface) {
  const double aspect = 0.1, n = 1.5, h = 2.0 * aspect, radius = (1.0 + h * h) / (2.0 * h);
  const auto lens = optics_of("kind: microlens, aspect: 0.1", n);
  core::PhotonRng rng({8, 0, 0}, 0);
  const Vec3 k = Vec3::UnitZ();
  double most = 0.0, mean2 = 0.0;
  int passed = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto out = lens->sample(core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng);
    ASSERT_TRUE(out);
    if (out->light.frame.k.z() < 0.0) continue;
    const double sine = std::hypot(out->light.frame.k.x(), out->light.frame.k.y());
    most = std::max(most, sine);
    mean2 += sine * sine;
    ++passed;
  }
  // The rim bends most: by asin(n sin tilt) - tilt. Mean of sin^2 by quadrature over r^2, with the share that passes.
  const auto bent = [&](double r) { return std::sin(std::asin(n * r / radius) - std::asin(r / radius)); };
  EXPECT_NEAR(most, bent(1.0), 2e-3);
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double r = std::sqrt((i + 0.5) / 1000.0);
    const core::FresnelFace face = core::fresnel(std::sqrt(1.0 - r * r / (radius * radius)), n, 1.0);
    const double T = 1.0 - 0.5 * (face.reflectance_s() + face.reflectance_p());
    sum += T * bent(r) * bent(r);
    weight += T;
  }
  EXPECT_NEAR(mean2 / passed, sum / weight, 0.01 * sum / weight);  // 0.6 % standard deviation / sqrt(50000) << 1 %
}

}  // namespace
}  // namespace evenglow::tests
