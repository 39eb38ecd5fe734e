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

TEST(AngularReceiver, SpotsHaveBinsOfTheirOwn) {
  const AngularReceiver receiver(2, 4, {{2.0, 3.0, 1.0}, {7.0, 3.0, 0.5}});
  EXPECT_EQ(receiver.bins(), 24U);
  EXPECT_EQ(receiver.directions(), 8U);
  EXPECT_EQ(receiver.first_bin(1), 16U);
  const auto bin = [&](double x, double y, Side side = Side::kTop) {
    const auto score = receiver.spot_score({side, {x, y, 0.0}, {0.1, 0.1, std::sqrt(0.98)}, true});
    return score ? static_cast<int>(score->bin) : -1;
  };
  EXPECT_EQ(bin(2.0, 3.99), 8);
  EXPECT_EQ(bin(7.3, 3.3), 16);
  EXPECT_EQ(bin(2.8, 3.8), -1);
  EXPECT_EQ(bin(7.0, 3.51), -1);
  EXPECT_EQ(bin(2.0, 3.0, Side::kLeft), -1);
  EXPECT_NEAR(receiver.spots()[1].area(), 0.25 * core::kPi, 1e-15);
}

TEST(AngularReceiver, SpotsOfTheDisplay) {
  const core::CellGrid area = core::CellGrid::over(5, 5, 10.0, 20.0, 110.0, 70.0);
  ASSERT_EQ(display_spots(area, 1, 2.0).size(), 1U);
  EXPECT_NEAR(display_spots(area, 1, 2.0)[0].x, 60.0, 1e-12);
  EXPECT_NEAR(display_spots(area, 1, 2.0)[0].y, 45.0, 1e-12);
  EXPECT_TRUE(display_spots(area, 0, 2.0).empty());
  EXPECT_EQ(display_spots(area, 9, 2.0).size(), 9U);
  const auto spots = display_spots(area, 13, 2.0);
  ASSERT_EQ(spots.size(), 13U);
  EXPECT_NEAR(spots[2].x, 100.0, 1e-12);  // 90 %, 10 %
  EXPECT_NEAR(spots[2].y, 25.0, 1e-12);
  EXPECT_NEAR(spots[10].x, 80.0, 1e-12);  // 70 %, 30 %
  EXPECT_NEAR(spots[10].y, 35.0, 1e-12);
  EXPECT_EQ(spots[12].radius, 2.0);
}

/// Each spot of a Lambertian face is as bright as the whole. False alarm 1e-3 for all bins together.
TEST(AngularReceiver, SpotsOfALambertianSourceAreEvenlyBright) {
  const tests::Traced traced(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom, flux_lm: 200}], "
      "receivers: [{kind: angular, polar_count: 3, azimuth_count: 2, at: 9}]",
      {400'000, 1, 100, 1});
  const AngularReceiver& receiver = *traced.scene().angular;
  ASSERT_EQ(receiver.spots().size(), 9U);
  EXPECT_NEAR(receiver.spots()[0].radius, 0.04 * std::hypot(20.0, 10.0), 1e-12);
  for (std::size_t spot = 0; spot < 9; ++spot) {
    const auto luminance = make_angular_luminance(receiver, traced.result().angular, 200.0, traced.result().photons,
                                                  receiver.spots()[spot].area(), receiver.first_bin(spot));
    ASSERT_EQ(luminance.size(), 6U);
    for (const core::Estimate& L : luminance) {
      EXPECT_LT(std::abs(tests::z_score(L, 1e6 / core::kPi)), tests::z_limit(1e-3, 54) * 1.1);
      EXPECT_LT(L.se / L.value, 0.06);
    }
  }
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
