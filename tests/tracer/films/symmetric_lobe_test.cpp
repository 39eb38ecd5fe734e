#include "tracer/films/symmetric_lobe.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

/// Integral over the hemisphere, by a rule of its own: midpoints in polar coordinates about the unscattered ray.
double integral(const SymmetricLobe& lobe, double beta_in) {
  constexpr int kWays = 1200, kTurns = 720;
  double sum = 0.0;
  for (int t = 0; t < kTurns; ++t) {
    const double phi = 2.0 * M_PI * (t + 0.5) / kTurns;
    const double c = std::cos(phi), s = std::sin(phi);
    const double horizon = std::sqrt(std::max(0.0, 1.0 - beta_in * beta_in * s * s)) - beta_in * c;
    const double reach = std::min(horizon, 9.0 * lobe.width());
    for (int w = 0; w < kWays; ++w) {
      const double d = reach * (w + 0.5) / kWays;
      const double out = std::sqrt(std::max(0.0, beta_in * beta_in + d * d + 2.0 * beta_in * d * c));
      sum += lobe.value(beta_in, out, d * d) * d * reach / kWays * 2.0 * M_PI / kTurns;
    }
  }
  return sum;
}

TEST(SymmetricLobe, LosesNothingAtAnyIncidence) {
  for (const double width : {0.0075, 0.05, 0.3, 0.82}) {
    const SymmetricLobe lobe(width);
    for (const double beta : {0.0, 0.342, 0.707, 0.866, 0.97, 0.985, 0.9962}) {
      EXPECT_NEAR(integral(lobe, beta), 1.0, 1e-5) << "width " << width << " beta " << beta;
    }
  }
}

TEST(SymmetricLobe, AcceptsByItsScaling) {
  for (const double width : {0.003, 0.05, 0.425, 2.0}) {
    const SymmetricLobe lobe(width);
    for (int i = 0; i < 20000; ++i) {
      const double beta2 = i / 20000.0;
      const double odds = lobe.scaling(std::sqrt(beta2)) / lobe.largest_scaling();
      ASSERT_TRUE(lobe.accepts(beta2, odds * (1.0 - 1e-9))) << width << " " << beta2;
      ASSERT_FALSE(lobe.accepts(beta2, odds * (1.0 + 1e-9))) << width << " " << beta2;
    }
  }
}

TEST(SymmetricLobe, ScalingIsOneFarFromTheHorizonAndMoreNearIt) {
  const SymmetricLobe lobe(0.02);
  EXPECT_NEAR(lobe.scaling(0.0), 1.0, 1e-6);
  EXPECT_NEAR(lobe.scaling(0.8), 1.0, 1e-6);
  EXPECT_GT(lobe.scaling(1.0), 1.3);
  for (double b = 0.0; b <= 1.0; b += 1e-4) EXPECT_LE(lobe.scaling(b), lobe.largest_scaling());
}

TEST(SymmetricLobe, BesselFunctionAgreesWithTheLibrary) {
  for (const double x : {0.0, 0.3, 2.0, 3.7, 3.8, 10.0, 80.0, 400.0}) {
    EXPECT_NEAR(scaled_bessel_i0(x) / (std::exp(-x) * std::cyl_bessel_i(0.0, x)), 1.0, 6e-7) << x;
  }
}

TEST(SymmetricLobe, RefusesOtherWidths) {
  EXPECT_THROW(SymmetricLobe(0.001), core::Error);
  EXPECT_THROW(SymmetricLobe(3.0), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
