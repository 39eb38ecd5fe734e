#include "tracer/films/abg_lobe.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"

namespace evenglow::tracer {
namespace {

struct Shape {
  double b, g;
};
/// Half widths 0.001 (polished glass), 0.01, 0.1 and 1.
const std::vector<Shape> kShapes{{1e-6, 2.0}, {1e-3, 1.5}, {1e-6, 3.0}, {1e-2, 2.0}, {1.0, 2.5}, {0.1, 0.5}};

/// Integral over the hemisphere, by a rule of its own: midpoints in polar coordinates about the unscattered ray, the
/// way as the exponential of an even grid.
double integral(const AbgLobe& lobe, double beta_in) {
  constexpr int kWays = 700, kTurns = 720;
  constexpr double kFirst = 1e-7;
  double sum = 0.0;
  for (int t = 0; t < kTurns; ++t) {
    const double phi = M_PI * (t + 0.5) / kTurns;
    const double c = std::cos(phi), s = std::sin(phi);
    const double horizon = std::sqrt(std::max(0.0, 1.0 - beta_in * beta_in * s * s)) - beta_in * c;
    if (horizon <= kFirst) continue;
    const double span = std::log(horizon / kFirst);
    for (int w = 0; w < kWays; ++w) {
      const double d = kFirst * std::exp(span * (w + 0.5) / kWays);
      const double out = std::sqrt(std::max(0.0, beta_in * beta_in + d * d + 2.0 * beta_in * d * c));
      sum += lobe.value(beta_in, out, d * d) * d * d * span / kWays * 2.0 * M_PI / kTurns;
    }
  }
  return sum;
}

TEST(AbgLobe, LosesNothingAtAnyIncidence) {
  for (const Shape& shape : kShapes) {
    const AbgLobe lobe(shape.b, shape.g);
    for (const double beta : {0.0, 0.5, 0.866, 0.985, 0.9962}) {
      EXPECT_NEAR(integral(lobe, beta), 1.0, 3e-4) << shape.b << " " << shape.g << " beta " << beta;
    }
  }
}

TEST(AbgLobe, HasItsShape) {
  // f(d) / f(0) = B / (B + d^g) but for the scaling, at a beta where that is flat.
  const AbgLobe lobe(1e-3, 1.5);
  for (const double d : {0.003, 0.01, 0.05, 0.2}) {
    const double scaling = lobe.scaling(d) / lobe.scaling(0.0);
    EXPECT_NEAR(lobe.value(0.0, d, d * d) / lobe.value(0.0, 0.0, 0.0), scaling * 1e-3 / (1e-3 + std::pow(d, 1.5)),
                1e-12);
    EXPECT_NEAR(scaling, 1.0, 0.05);
  }
}

/// Draws of the way against the closed integral of d / (B + d^2); chance of a false alarm 1e-4. Seed fixed.
TEST(AbgLobe, DrawsFollowTheShape) {
  const double b = 1e-4;
  const AbgLobe lobe(b, 2.0);
  const AbgLobe other(1e-3, 3.0);
  constexpr int kBins = 40, kDraws = 200000;
  std::vector<double> counts(kBins, 0.0), expected(kBins, static_cast<double>(kDraws) / kBins);
  core::PhotonRng rng({5, 0, 0}, 0);
  for (int i = 0; i < kDraws; ++i) {
    const double d = lobe.draw_way(rng);
    ASSERT_GT(d, 0.0);
    ASSERT_LE(d, 2.0 + 1e-12);
    const double share = std::log1p(d * d / b) / std::log1p(4.0 / b);
    counts[std::min(static_cast<std::size_t>(share * kBins), std::size_t{kBins - 1})] += 1.0;
    ASSERT_LE(other.draw_way(rng), 2.0 + 1e-12);
  }
  EXPECT_GT(tests::chi_square_test(counts, expected).p_value, 1e-4);
}

TEST(AbgLobe, ScalingStaysBelowItsBound) {
  for (const Shape& shape : kShapes) {
    const AbgLobe lobe(shape.b, shape.g);
    for (double t = 1e-7; t <= 1.0; t *= 1.01) EXPECT_LE(lobe.scaling(1.0 - t), lobe.largest_scaling());
    EXPECT_LE(lobe.scaling(1.0), lobe.largest_scaling());
    EXPECT_LT(lobe.largest_scaling(), 6.0);
  }
}

TEST(AbgLobe, RefusesOtherShapes) {
  EXPECT_THROW(AbgLobe(1e-8, 2.0), core::Error);
  EXPECT_THROW(AbgLobe(5.0, 2.0), core::Error);
  EXPECT_THROW(AbgLobe(1e-2, 0.3), core::Error);
  EXPECT_THROW(AbgLobe(1e-2, 7.0), core::Error);
  EXPECT_THROW(AbgLobe(-1.0, 2.0), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
