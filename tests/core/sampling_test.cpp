#include "core/math/sampling.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"
#include "tests/support/chi_square.h"
#include "tests/support/z_test.h"

/// Directions against the cumulative distribution of their polar angle and an even azimuth. False alarm 1e-3 a test.
namespace evenglow::core {
namespace {

constexpr int kPolar = 20, kAzimuth = 12, kSamples = 200000;

void check(const std::function<Vec3(double, double)>& sample, const std::function<double(double)>& cumulative,
           double chance) {
  std::vector<double> counts(kPolar * kAzimuth, 0.0);
  PhotonRng rng({20260101, 1, 0}, 0);
  for (int i = 0; i < kSamples; ++i) {
    const double u1 = rng.uniform();
    const Vec3 k = sample(u1, rng.uniform());
    ASSERT_NEAR(k.norm(), 1.0, 1e-14);
    ASSERT_GE(k.z(), 0.0);
    // The cumulative distribution of theta is uniform if it is the right one.
    const int p = std::min(static_cast<int>(cumulative(k.z()) * kPolar), kPolar - 1);
    double azimuth = std::atan2(k.y(), k.x());
    if (azimuth < 0.0) azimuth += 2.0 * kPi;
    const int a = std::min(static_cast<int>(azimuth / (2.0 * kPi) * kAzimuth), kAzimuth - 1);
    counts[static_cast<std::size_t>(p * kAzimuth + a)] += 1.0;
  }
  const std::vector<double> expected(counts.size(), static_cast<double>(kSamples) / static_cast<double>(counts.size()));
  EXPECT_GT(tests::chi_square_test(counts, expected).p_value, chance);
}

TEST(Sampling, CosineAndSineOfATurn) {
  for (int i = 0; i <= 100000; ++i) {
    const double turn = i / 100000.0;
    const TurnCosSin phi(turn);
    ASSERT_NEAR(phi.cos, std::cos(2.0 * kPi * turn), 2e-15) << turn;
    ASSERT_NEAR(phi.sin, std::sin(2.0 * kPi * turn), 2e-15) << turn;
  }
}

TEST(Sampling, Lambertian) {
  check(
      sample_lambertian, [](double c) { return 1.0 - c * c; }, 1e-3);
}

TEST(Sampling, CosinePower) {
  for (const double n : {0.1, 1.0, 3.0, 80.0}) {
    check([n](double u1, double u2) { return sample_cosine_power(u1, u2, n); },
          [n](double c) { return 1.0 - std::pow(c, n + 1.0); }, tests::sidak(1e-3, 4));
  }
}

TEST(Sampling, CosineCone) {
  for (const double degrees : {0.5, 10.0, 90.0}) {
    const double s = std::sin(degrees * kRadPerDeg);
    check([s](double u1, double u2) { return sample_cosine_cone(u1, u2, s); },
          [s](double c) { return (1.0 - c * c) / (s * s); }, tests::sidak(1e-3, 3));
  }
  EXPECT_EQ(sample_cosine_cone(0.3, 0.7, 0.0), Vec3::UnitZ());
}

}  // namespace
}  // namespace evenglow::core
