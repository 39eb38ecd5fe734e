#include "design/problem/chromaticity_batches.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/light/color.h"

namespace evenglow::design {
namespace {

using core::Vec3;

/// Batches of a white light whose blue and yellow parts vary: X, Y and Z are strongly correlated.
std::vector<Vec3> noisy_batches(std::size_t count, double noise, std::mt19937_64& random) {
  const Vec3 blue(0.35, 0.05, 1.8), yellow(0.7, 0.95, 0.02);
  std::normal_distribution<double> normal;
  std::vector<Vec3> batches;
  for (std::size_t b = 0; b < count; ++b) {
    const double first = 1.0 + noise * normal(random), second = 1.0 + noise * normal(random);
    batches.emplace_back(0.5 * first * blue + second * yellow);
  }
  return batches;
}

/// Every figure against the jackknife, which knows nothing of gradients; it agrees to first order in the noise.
TEST(ChromaticityBatches, ErrorsAreThoseOfTheJackknife) {
  std::mt19937_64 random(5);
  const std::vector<Vec3> batches = noisy_batches(100, 0.01, random);
  const ColorPoint point = color_point(batches);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& xyz : batches) sum += xyz;
  const auto jackknife = [&](auto&& figure) {
    double mean = 0.0, squares = 0.0;
    for (const Vec3& xyz : batches) mean += figure(Vec3(sum - xyz)) / 100.0;
    for (const Vec3& xyz : batches) squares += std::pow(figure(Vec3(sum - xyz)) - mean, 2);
    return std::sqrt(0.99 * squares);
  };
  const auto check = [&](const core::Estimate& estimate, auto&& figure, double tolerance) {
    EXPECT_NEAR(estimate.value, figure(sum), 1e-6 * std::abs(figure(sum)));
    EXPECT_NEAR(estimate.se / jackknife(figure), 1.0, tolerance);
    EXPECT_GT(estimate.se, 0.0);
  };
  check(
      point.x, [](const Vec3& s) { return core::chromaticity_xy(s).x(); }, 1e-3);
  check(
      point.y, [](const Vec3& s) { return core::chromaticity_xy(s).y(); }, 1e-3);
  check(
      point.u, [](const Vec3& s) { return core::chromaticity_uv(s).x(); }, 1e-3);
  check(
      point.v, [](const Vec3& s) { return core::chromaticity_uv(s).y(); }, 1e-3);
  check(
      point.kelvin, [](const Vec3& s) { return core::color_temperature(s).kelvin; }, 0.02);
  check(
      point.distance, [](const Vec3& s) { return core::color_temperature(s).distance; }, 0.02);
}

TEST(ChromaticityBatches, ResidualsSumToZero) {
  std::mt19937_64 random(6);
  const ChromaticityBatches color = chromaticity_batches(noisy_batches(20, 0.1, random));
  core::Vec2 sum = core::Vec2::Zero();
  for (const core::Vec2& r : color.residuals) sum += r;
  EXPECT_NEAR(sum.norm(), 0.0, 1e-15);
}

/// Noise that X, Y and Z share is no noise of the color.
TEST(ChromaticityBatches, CommonNoiseDropsOut) {
  const Vec3 white(0.95, 1.0, 1.09);
  const ColorPoint point = color_point({0.5 * white, 2.0 * white, 1.0 * white, 1.1 * white});
  EXPECT_NEAR(point.u.se, 0.0, 1e-15);
  EXPECT_NEAR(point.kelvin.se, 0.0, 1e-6);
}

TEST(ChromaticityBatches, ABlackBodyHasItsOwnTemperature) {
  for (const double kelvin : {3000.0, 6500.0}) {
    const ColorPoint point = color_point({core::black_body(kelvin)});
    EXPECT_NEAR(point.kelvin.value, kelvin, 1e-3 * kelvin);
    EXPECT_NEAR(point.distance.value, 0.0, 1e-6);
    EXPECT_EQ(point.u.se, 0.0);  // one batch: taken as exact
  }
}

}  // namespace
}  // namespace evenglow::design
