#include "tracer/receivers/luminance_receiver.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

namespace evenglow::tracer {
namespace {

const core::CellGrid kCells = core::CellGrid::over(4, 2, 1.0, 1.0, 9.0, 5.0);
constexpr double kCone = 10.0 * core::kRadPerDeg;

Crossing crossing(double x, double y, double polar_deg, Side side = Side::kTop, bool estimated = false) {
  const double t = polar_deg * core::kRadPerDeg;
  return {side, {x, y, 0.6}, {std::sin(t), 0.0, std::cos(t)}, estimated};
}

TEST(LuminanceReceiver, ScoresTheConeAndTheActiveArea) {
  const LuminanceReceiver receiver(kCells, kCone);
  EXPECT_EQ(receiver.bins(), 8U);
  const auto score = receiver.score(crossing(3.5, 3.5, 9.9));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->bin, 5U);
  EXPECT_DOUBLE_EQ(score->weight, 1.0 / (core::kPi * std::pow(std::sin(kCone), 2)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 10.1)));
  EXPECT_FALSE(receiver.score(crossing(0.5, 3.5, 0.0)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 0.0, Side::kBottom)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 0.0, Side::kTop, true)));  // counted before
}

TEST(LuminanceReceiver, RefusesImpossibleCones) {
  EXPECT_THROW(LuminanceReceiver(kCells, 0.0), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, 2.0), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, 0.5, 1.1), core::Error);  // below the horizon
  EXPECT_THROW(LuminanceReceiver(kCells, 0.5, -0.1), core::Error);
}

TEST(LuminanceReceiver, TiltedCone) {
  const double polar = 40.0 * core::kRadPerDeg, azimuth = 120.0 * core::kRadPerDeg;
  const LuminanceReceiver receiver(kCells, kCone, polar, azimuth);
  const auto seen = [&](double polar_deg, double azimuth_deg) {
    const double t = polar_deg * core::kRadPerDeg, a = azimuth_deg * core::kRadPerDeg;
    return receiver.score(
        {Side::kTop, {3.5, 3.5, 0.6}, {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)}, false});
  };
  ASSERT_TRUE(seen(40, 120));
  EXPECT_EQ(seen(40, 120)->bin, 5U);
  EXPECT_DOUBLE_EQ(seen(40, 120)->weight, 1.0 / (core::kPi * std::pow(std::sin(kCone), 2) * std::cos(polar)));
  EXPECT_TRUE(seen(49.9, 120));
  EXPECT_FALSE(seen(50.1, 120));
  EXPECT_TRUE(seen(30.1, 120));
  EXPECT_FALSE(seen(29.9, 120));
  EXPECT_TRUE(seen(40, 120 + 15));  // 15 degrees of azimuth are less than 10 degrees here
  EXPECT_FALSE(seen(40, 120 + 16.5));
  EXPECT_FALSE(seen(40, 60));
  EXPECT_FALSE(seen(0, 0));
}

/// The projected solid angle of the cone by a sum over a fine grid of directions, and the directions drawn for the
/// next-event estimate: within the cone, and their weighted means are the means over the cone of a luminance of 1 and
/// of one that grows with the cosine.
TEST(LuminanceReceiver, TiltedConeIsNormalizedExactly) {
  for (const double polar_deg : {0.0, 25.0, 70.0}) {
    const double cone = 18.0 * core::kRadPerDeg, polar = polar_deg * core::kRadPerDeg;
    const LuminanceReceiver receiver(kCells, cone, polar, 0.7);
    double solid = 0.0, cosine = 0.0;
    constexpr int kSteps = 1500;
    const double step = 0.5 * core::kPi / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < 4 * kSteps; ++j) {
        const double t = (i + 0.5) * step, a = (j + 0.5) * step;
        const auto score = receiver.score(
            {Side::kTop, {3.5, 3.5, 0.6}, {std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)}, false});
        if (!score) continue;
        const double share = std::cos(t) * std::sin(t) * step * step * score->weight;
        solid += share;
        cosine += share * std::cos(t);
      }
    }
    EXPECT_NEAR(solid, 1.0, 2e-3) << polar_deg;
    double weights = 0.0, weighted = 0.0;
    constexpr int kDraws = 300;  // a grid of the two numbers: no noise
    for (int i = 0; i < kDraws; ++i) {
      for (int j = 0; j < kDraws; ++j) {
        const View view = receiver.sample_view((i + 0.5) / kDraws, (j + 0.5) / kDraws);
        EXPECT_TRUE(receiver.score({Side::kTop, {3.5, 3.5, 0.6}, view.k, false}));
        weights += view.weight / (kDraws * kDraws);
        weighted += view.weight * view.k.z() / (kDraws * kDraws);
      }
    }
    EXPECT_NEAR(weights, 1.0, 1e-4) << polar_deg;
    EXPECT_NEAR(weighted, cosine, 2e-3) << polar_deg;
  }
}

/// A Lambertian source of 200 lm on 200 mm2 has the luminance M / pi in every direction, and a grid of cells shows it
/// at each place. False alarm 1e-3 for all directions together.
TEST(LuminanceReceiver, LambertianSourceIsEvenlyBrightInEveryDirection) {
  for (const char* direction : {"[0, 0]", "[30, 0]", "[30, 200]", "[60, 90]", "[75, 315]"}) {
    const tests::Traced traced(
        "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom, flux_lm: 200}], "
        "receivers: [{kind: luminance, cells: [2, 2], cone_deg: 10, direction_deg: " +
            std::string(direction) + "}]",
        {400'000, 1, 100, 1});
    const core::Estimate mean = traced.mean_luminance();
    EXPECT_LT(std::abs(tests::z_score(mean, 1e6 / core::kPi)), tests::z_limit(1e-3, 5)) << direction;
    EXPECT_LT(mean.se / mean.value, 0.025);
  }
}

/// 100 lm over 200 photons, one photon with score w into a cell of 4 mm2: L = 0.5 w / 4 lm/(sr mm2), times 10^6.
TEST(LuminanceReceiver, Unit) {
  const LuminanceReceiver receiver(kCells, kCone);
  EXPECT_DOUBLE_EQ(luminance_per_score(receiver, 100.0, 200), 0.5 / 4.0 * 1e6);
  core::Tally tally(8);
  tally.add_batch({1, 0, 0, 0, 0, 0, 0, 3});
  tally.add_batch({3, 0, 0, 0, 0, 0, 0, 3});
  const LuminanceMap map = make_luminance_map(receiver, tally, 100.0, 200);
  EXPECT_DOUBLE_EQ(map.luminance.values[0], 4.0 * 125000.0);
  EXPECT_DOUBLE_EQ(map.standard_error.values[0], std::sqrt(2.0 * 2.0) * 125000.0);
  EXPECT_EQ(map.standard_error.values[7], 0.0);
}

}  // namespace
}  // namespace evenglow::tracer
