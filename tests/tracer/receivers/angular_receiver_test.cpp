#include "tracer/receivers/angular_receiver.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "core/montecarlo/photon_rng.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

namespace evenglow::tracer {
namespace {

TEST(AngularReceiver, Bins) {
  const AngularReceiver receiver(9, 12);
  EXPECT_EQ(receiver.bins(), 108U);
  const auto bin = [&](double polar_deg, double azimuth_deg, Side side = Side::kTop) {
    const double t = polar_deg * core::kRadPerDeg, a = azimuth_deg * core::kRadPerDeg;
    const auto score =
        receiver.score({side, {}, {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)}, true});
    return score ? static_cast<int>(score->bin) : -1;
  };
  EXPECT_EQ(bin(5.0, 5.0), 0);
  EXPECT_EQ(bin(15.0, 95.0), 12 + 3);
  EXPECT_EQ(bin(89.9, 359.9), 107);
  EXPECT_EQ(bin(15.0, -5.0), 23);
  EXPECT_EQ(bin(15.0, 5.0, Side::kLeft), -1);
  EXPECT_NEAR(receiver.polar_edge(9), 0.5 * core::kPi, 1e-15);
}

TEST(AngularReceiver, ProjectedSolidAnglesSumToPi) {
  const AngularReceiver receiver(18, 24);
  double sum = 0.0;
  for (int i = 0; i < 18; ++i) sum += 24.0 * receiver.projected_solid_angle(i);
  EXPECT_NEAR(sum, core::kPi, 1e-12);
}

/// A Lambertian source has the luminance M / pi in every direction. False alarm 1e-3 for all bins together.
TEST(AngularReceiver, LambertianSourceIsEvenlyBright) {
  const tests::Traced traced(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom, flux_lm: 200}], "
      "receivers: [{kind: angular, polar_count: 9, azimuth_count: 8}]",
      {400'000, 1, 100, 1});
  const auto luminance =
      make_angular_luminance(*traced.scene().angular, traced.result().angular, 200.0, traced.result().photons, 200.0);
  for (const core::Estimate& L : luminance) {
    EXPECT_LT(std::abs(tests::z_score(L, 1e6 / core::kPi)), tests::z_limit(1e-3, 72) * 1.1);  // Student's t of 99
    EXPECT_LT(L.se / L.value, 0.05);
  }
}

}  // namespace
}  // namespace evenglow::tracer
