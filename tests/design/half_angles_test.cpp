#include "design/problem/half_angles.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

constexpr int kRings = 45, kAzimuths = 24;
constexpr double kDeg = std::numbers::pi / 180.0;

using Luminance = std::function<double(double polar, double azimuth)>;

/// cos^n in the direction of x, cos^m in that of y, by powers that change with the azimuth.
Luminance elliptic(double n, double m) {
  return [=](double polar, double azimuth) {
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    return std::pow(std::cos(polar), n * c * c + m * s * s);
  };
}

DirectionBins bins(std::size_t first = 0) {
  return {first, kAzimuths, std::vector<double>(kRings, 1.0)};
}

/// Luminance at the middle of each bin, with normal noise of relative size `noise` in each of `batches`.
core::Tally tally_of(const Luminance& luminance, double noise, std::size_t batches, std::mt19937_64& random,
                     std::size_t first = 0) {
  core::Tally tally(first + kRings * kAzimuths);
  std::normal_distribution<double> normal;
  for (std::size_t b = 0; b < batches; ++b) {
    std::vector<double> sums(tally.bins(), 0.0);
    for (int p = 0; p < kRings; ++p) {
      for (int a = 0; a < kAzimuths; ++a) {
        const double value = luminance((p + 0.5) * 90.0 / kRings * kDeg, (a + 0.5) * 360.0 / kAzimuths * kDeg);
        sums[first + static_cast<std::size_t>(p * kAzimuths + a)] = value * (1.0 + noise * normal(random));
      }
    }
    tally.add_batch(std::move(sums));
  }
  return tally;
}

double half_angle(double n) {
  return std::acos(std::pow(0.5, 1.0 / n)) / kDeg;
}

TEST(HalfAngles, OfPowersOfTheCosine) {
  std::mt19937_64 random(1);
  const core::Tally tally = tally_of(elliptic(8.0, 3.0), 0.0, 10, random, 7);
  const auto across = half_angles(tally, bins(7), 0.0), up = half_angles(tally, bins(7), 90.0);
  ASSERT_TRUE(across && up);
  // The two bins beside an azimuth lie 7.5 degrees off it: the power there is between the two.
  const double c2 = std::pow(std::cos(7.5 * kDeg), 2);
  EXPECT_NEAR(across->to_deg.value, half_angle(8.0 * c2 + 3.0 * (1.0 - c2)), 0.1);
  EXPECT_NEAR(up->to_deg.value, half_angle(3.0 * c2 + 8.0 * (1.0 - c2)), 0.1);
  EXPECT_NEAR(across->from_deg.value, -across->to_deg.value, 1e-9);
  EXPECT_NEAR(across->width_deg.value, 2.0 * across->to_deg.value, 1e-9);
  EXPECT_NEAR(across->width_deg.se, 0.0, 1e-9);
}

/// A lobe of 20 degrees half width about 30 degrees: the half angles are those of the lobe, not of the normal.
TEST(HalfAngles, OfALobeBesideTheNormal) {
  std::mt19937_64 random(1);
  const auto lobe = [](double polar, double azimuth) {
    const double angle = std::cos(azimuth) > 0.0 ? polar : -polar;
    return std::exp(-std::numbers::ln2 * std::pow((angle / kDeg - 30.0) / 20.0, 2));
  };
  const auto angles = half_angles(tally_of(lobe, 0.0, 10, random), bins(), 0.0);
  ASSERT_TRUE(angles);
  EXPECT_NEAR(angles->from_deg.value, 10.0, 0.2);
  EXPECT_NEAR(angles->to_deg.value, 50.0, 0.2);
}

/// Side lobes as bright as the main one, as prism films have them, are no part of it.
TEST(HalfAngles, SideLobesDoNotCount) {
  std::mt19937_64 random(3);
  const auto lobes = [](double polar, double) {
    return std::exp(-std::numbers::ln2 * std::pow(polar / kDeg / 25.0, 2)) + (polar > 65.0 * kDeg ? 1.5 : 0.0);
  };
  const auto angles = half_angles(tally_of(lobes, 0.01, 20, random), bins(), 90.0);
  ASSERT_TRUE(angles);
  EXPECT_NEAR(angles->to_deg.value, 25.0, 0.5);
  EXPECT_NEAR(angles->from_deg.value, -25.0, 0.5);
  EXPECT_GT(angles->width_deg.se, 0.0);
  EXPECT_LT(angles->width_deg.se, 0.5);
}

TEST(HalfAngles, NoneWhereTheLuminanceDoesNotFall) {
  std::mt19937_64 random(1);
  EXPECT_FALSE(half_angles(tally_of([](double, double) { return 1.0; }, 0.0, 10, random), bins(), 0.0));
  EXPECT_FALSE(half_angles(tally_of([](double, double) { return 0.0; }, 0.0, 10, random), bins(), 0.0));
}

/// The unit of each ring counts: counts of a Lambertian source grow with the projected solid angle.
TEST(HalfAngles, RingsHaveUnitsOfTheirOwn) {
  std::mt19937_64 random(1);
  DirectionBins own = bins();
  for (int p = 0; p < kRings; ++p) own.ring_unit[static_cast<std::size_t>(p)] = 1.0 / (1.0 + p);
  const auto counted = [](double polar, double) {
    return std::pow(std::cos(polar), 4.0) * (1.0 + std::floor(polar / kDeg / 2.0));
  };
  const auto angles = half_angles(tally_of(counted, 0.0, 10, random), own, 0.0);
  ASSERT_TRUE(angles);
  EXPECT_NEAR(angles->to_deg.value, half_angle(4.0), 0.1);
}

/// 300 repetitions: the width of the pulls has a standard error of 0.041; 0.15 is more than 3 (false alarm 0.002 each).
TEST(HalfAngles, PullsHaveUnitWidth) {
  std::mt19937_64 random(2);
  // A peak that no noise can move: the innermost ring.
  const auto steep = [](double polar, double) { return polar < 2.0 * kDeg ? 2.0 : 2.0 * std::exp(-polar / 0.5); };
  const double expected = half_angles(tally_of(steep, 0.0, 10, random), bins(), 0.0)->to_deg.value;
  double sum = 0.0, squares = 0.0, widths = 0.0, width_pulls = 0.0;
  for (int i = 0; i < 300; ++i) {
    const auto angles = half_angles(tally_of(steep, 0.05, 50, random), bins(), 0.0);
    const double pull = (angles->to_deg.value - expected) / angles->to_deg.se;
    sum += pull / 300.0;
    squares += pull * pull / 300.0;
    const double other = (angles->width_deg.value - 2.0 * expected) / angles->width_deg.se;
    widths += other / 300.0;
    width_pulls += other * other / 300.0;
  }
  EXPECT_NEAR(std::sqrt(squares - sum * sum), 1.0, 0.15);
  EXPECT_NEAR(std::sqrt(width_pulls - widths * widths), 1.0, 0.15);
  EXPECT_LT(std::abs(sum), 0.3);
}

}  // namespace
}  // namespace evenglow::design
