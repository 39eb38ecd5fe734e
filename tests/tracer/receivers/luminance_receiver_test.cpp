#include "tracer/receivers/luminance_receiver.h"

#include <algorithm>
#include <cmath>
#include <vector>

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
  EXPECT_THROW(LuminanceReceiver(kCells, -0.1), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, 2.0), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, 0.5, 1.1), core::Error);  // below the horizon
  EXPECT_THROW(LuminanceReceiver(kCells, 0.5, -0.1), core::Error);
}

TEST(LuminanceReceiver, SeveralDirectionsHaveBinsOfTheirOwn) {
  const double tilt = 15.0 * core::kRadPerDeg;
  const LuminanceReceiver receiver(kCells, kCone, {{0.0, 0.0, 0.75}, {tilt, 0.0, 0.25}});
  EXPECT_EQ(receiver.bins(), 16U);
  const double weight = 1.0 / (core::kPi * std::pow(std::sin(kCone), 2));
  const Crossing both = crossing(3.5, 3.5, 7.0);  // the cones overlap
  ASSERT_TRUE(receiver.score(both, 0) && receiver.score(both, 1));
  EXPECT_EQ(receiver.score(both, 0)->bin, 5U);
  EXPECT_EQ(receiver.score(both, 1)->bin, 13U);
  EXPECT_DOUBLE_EQ(receiver.score(both, 0)->weight, 0.75 * weight);
  EXPECT_DOUBLE_EQ(receiver.score(both, 1)->weight, 0.25 * weight / std::cos(tilt));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 20.0), 0));
  EXPECT_TRUE(receiver.score(crossing(3.5, 3.5, 20.0), 1));
  // Views: three of four along the normal, each direction from its whole cone.
  int first = 0;
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const View view = receiver.sample_view(core::Vec3::Zero(), (i + 0.5) / 1000.0, 0.3);
    first += view.direction == 0 ? 1 : 0;
    const core::Vec3 axis = view.direction == 0 ? core::Vec3(0, 0, 1) : core::Vec3(std::sin(tilt), 0, std::cos(tilt));
    EXPECT_GE(view.k.dot(axis), std::cos(kCone) - 1e-9);
    if (view.direction == 1) {
      least = std::min(least, view.k.dot(axis));
      most = std::max(most, view.k.dot(axis));
    }
    EXPECT_EQ(receiver.score_view({3.5, 3.5, 0.6}, view)->bin, view.direction * 8 + 5);
  }
  EXPECT_EQ(first, 750);
  EXPECT_LT(least, 0.99);
  EXPECT_GT(most, 0.9999);
  EXPECT_THROW(LuminanceReceiver(kCells, kCone, {{0.0, 0.0, 0.5}}), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, kCone, {{1.5, 0.0, 1.0}}), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, kCone, std::vector<ViewDirection>{}), core::Error);
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
        const View view = receiver.sample_view({3.5, 3.5, 0.6}, (i + 0.5) / kDraws, (j + 0.5) / kDraws);
        EXPECT_TRUE(receiver.score({Side::kTop, {3.5, 3.5, 0.6}, view.k, false}));
        weights += view.weight / (kDraws * kDraws);
        weighted += view.weight * view.k.z() / (kDraws * kDraws);
      }
    }
    EXPECT_NEAR(weights, 1.0, 1e-4) << polar_deg;
    EXPECT_NEAR(weighted, cosine, 2e-3) << polar_deg;
  }
}

/// The projected solid angle of a pupil by a sum over rings of the disk, for near and far, small and wide pupils.
TEST(Pupil, ProjectedSolidAngle) {
  struct Case {
    double aside, height, radius;
  };
  for (const Case& c : {Case{0, 500, 2}, {300, 500, 2}, {3, 10, 20}, {25, 10, 20}, {20, 10, 20}, {4, 2, 0.5}}) {
    const Pupil pupil{{7.0 + c.aside, 3.0, 0.6 + c.height}, c.radius, 0.6};
    double sum = 0.0;
    constexpr int kSteps = 600;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const double r = c.radius * (i + 0.5) / kSteps, phi = 2.0 * core::kPi * (j + 0.5) / kSteps;
        const double d2 =
            std::pow(c.aside + r * std::cos(phi), 2) + std::pow(r * std::sin(phi), 2) + c.height * c.height;
        sum += c.height * c.height / (d2 * d2) * r * c.radius / kSteps * 2.0 * core::kPi / kSteps;
      }
    }
    EXPECT_NEAR(pupil.projected_solid_angle({7, 3, 0.6}) / sum, 1.0, 2e-5) << c.aside << " " << c.height;
  }
  EXPECT_NEAR(Pupil({{0, 0, 1e5}, 0.05, 0.0}).projected_solid_angle({0, 0, 0}) / (core::kPi * 2.5e-13), 1.0, 1e-12);
}

TEST(Pupil, RefusesImpossibleOnes) {
  EXPECT_THROW(LuminanceReceiver(kCells, Pupil{{5, 3, 100}, 0.0, 0.6}), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, Pupil{{5, 3, 0.6}, 1.0, 0.6}), core::Error);
}

TEST(Pupil, CountsLightThatComesIn) {
  const LuminanceReceiver receiver(kCells, Pupil{{5, 3, 10.6}, 2.0, 0.6});
  const auto seen = [&](double x, double y) {  // through this point of the pupil's plane, from (3.5, 3.5)
    return receiver.score({Side::kTop, {3.5, 3.5, 0.6}, core::Vec3(x - 3.5, y - 3.5, 10.0).normalized(), false});
  };
  ASSERT_TRUE(seen(5, 3));
  EXPECT_EQ(seen(5, 3)->bin, 5U);
  EXPECT_TRUE(seen(6.99, 3));
  EXPECT_FALSE(seen(7.01, 3));
  EXPECT_FALSE(seen(3.5, 4.5));
  EXPECT_FALSE(receiver.score({Side::kTop, {3.5, 3.5, 0.6}, {0, 0, 1}, true}));
  EXPECT_FALSE(receiver.score({Side::kBottom, {3.5, 3.5, 0.6}, {0, 0, -1}, false}));
}

/// A Lambertian plane, seen through pupils near and far, has the same luminance in every cell, though the light that
/// comes in from the edge is a tenth of that of the center. False alarm 1e-3 for all cells and pupils together.
TEST(Pupil, LambertianScreenIsEvenlyBright) {
  const char* const pupils[] = {"{distance_mm: 20, diameter_mm: 20}",
                                "{distance_mm: 20, diameter_mm: 20, at: [25, 20]}",
                                "{distance_mm: 10, diameter_mm: 30, at: [5, 5]}"};
  for (const char* pupil : pupils) {
    const tests::Traced traced(
        "size: {length_mm: 20, width_mm: 20}, sources: [{kind: lambertian_face, face: bottom, flux_lm: 400}], "
        "receivers: [{kind: luminance, cells: [3, 3], pupil: " +
            std::string(pupil) + "}]",
        {400'000, 1, 100, 1});
    const LuminanceMap map = traced.map();
    for (std::size_t i = 0; i < 9; ++i) {
      const double z = (map.luminance.values[i] - 1e6 / core::kPi) / map.standard_error.values[i];
      EXPECT_LT(std::abs(z), tests::z_limit(1e-3, 27)) << pupil << " " << i;
    }
  }
}

/// Through a sheet of glass, cell by cell: the transmittance of the sheet in the direction of the pupil. The mean over
/// the pupil is taken here with numbers of its own, for a sheet without absorption: T = mean of (1 - R) / (1 + R) over
/// s and p.
TEST(Pupil, DirectionOfViewVariesOverTheDisplay) {
  constexpr double kIndex = 1.8, kHeight = 100.0, kRadius = 40.0;
  const auto transmittance = [&](double cos_i) {
    const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (kIndex * kIndex));
    const double s = std::pow((cos_i - kIndex * cos_t) / (cos_i + kIndex * cos_t), 2);
    const double p = std::pow((kIndex * cos_i - cos_t) / (kIndex * cos_i + cos_t), 2);
    return 0.5 * ((1.0 - s) / (1.0 + s) + (1.0 - p) / (1.0 + p));
  };
  const tests::Traced traced(
      "size: {length_mm: 400, width_mm: 60}, sources: [{kind: lambertian_face, face: bottom, flux_lm: 24000}], films: "
      "[{kind: sheet, refractive_index: 1.8, thickness_mm: 0.02, gap_mm: 0.02}], receivers: [{kind: luminance, cells: "
      "[5, 1], margins: {left_mm: 5, right_mm: 5, front_mm: 5, back_mm: 5}, pupil: {distance_mm: 100, diameter_mm: 80, "
      "at: [24, 30]}}]",
      {2'000'000, 3, 100, 1});
  const LuminanceMap map = traced.map();
  double first = 0.0, last = 0.0;
  for (int cell = 0; cell < 5; ++cell) {
    double sum = 0.0, weights = 0.0;
    constexpr int kSteps = 24;
    for (int i = 0; i < kSteps * kSteps * kSteps * kSteps; ++i) {
      const auto step = [&](int n) { return ((i / n) % kSteps + 0.5) / kSteps; };
      const double x = 5.0 + 78.0 * (cell + step(1)), y = 5.0 + 50.0 * step(kSteps);
      const double r = kRadius * std::sqrt(step(kSteps * kSteps));
      const double phi = 2.0 * core::kPi * step(kSteps * kSteps * kSteps);
      const double a2 = std::pow(24.0 + r * std::cos(phi) - x, 2) + std::pow(30.0 + r * std::sin(phi) - y, 2);
      const double d2 = a2 + kHeight * kHeight;
      const Pupil pupil{{24, 30, kHeight}, kRadius, 0.0};
      sum += transmittance(kHeight / std::sqrt(d2)) / (d2 * d2) / pupil.projected_solid_angle({x, y, 0});
      weights += 1.0 / (d2 * d2) / pupil.projected_solid_angle({x, y, 0});
    }
    const double expected = 1e6 / core::kPi * sum / weights;
    const auto i = static_cast<std::size_t>(cell);
    // The rim of the source is seen through the sheet from 0.04 mm aside at most: nothing of the cells within 5 mm.
    EXPECT_LT(std::abs(map.luminance.values[i] - expected) / map.standard_error.values[i], tests::z_limit(1e-3, 5))
        << cell << " " << expected << " " << map.luminance.values[i];
    if (cell == 0) first = expected;
    if (cell == 4) last = expected;
  }
  EXPECT_LT(last, 0.85 * first);
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
