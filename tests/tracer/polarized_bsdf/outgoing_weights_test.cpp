#include "tracer/polarized_bsdf/outgoing_weights.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

constexpr double kDeg = core::kRadPerDeg;

TEST(OutgoingWeights, SumToTheProjectedHemisphere) {
  for (const double sigma : {0.0, 30.0, 60.0, 85.0, 89.5}) {
    const auto w = outgoing_weights(32, 40, sigma * kDeg);
    ASSERT_EQ(w.size(), 40u * 33u);
    EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), core::kPi, 1e-7) << sigma;
    for (const double weight : w) EXPECT_GT(weight, 0.0);
  }
}

/// The integral of u (a hat function reproduces it) over the disk at normal incidence: 2 pi x integral of 2 u^4.
TEST(OutgoingWeights, IntegrateWhatIsLinearExactly) {
  const auto w = outgoing_weights(8, 12, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * static_cast<double>(i % 9) / 8.0;
  EXPECT_NEAR(sum, 2.0 * core::kPi * 2.0 / 5.0, 1e-9);
}

/// cos of the outgoing ray over the hemisphere, dbeta = cos dOmega: 2 pi / 3, whatever the incidence. With the
/// interpolation error of the grid.
TEST(OutgoingWeights, IntegrateASmoothFunction) {
  for (const double sigma : {0.0, 45.0, 75.0}) {
    const auto w = outgoing_weights(64, 80, sigma * kDeg);
    double sum = 0.0;
    for (std::size_t k = 0; k < 80; ++k) {
      for (std::size_t i = 0; i <= 64; ++i) {
        const double phi = 2.0 * core::kPi * static_cast<double>(k) / 80.0, u = static_cast<double>(i) / 64.0;
        const double s = std::sin(sigma * kDeg), c = std::cos(sigma * kDeg);
        const double way = u * u * horizon_distance(s, c * c, std::cos(phi), std::sin(phi));
        const double x = s + way * std::cos(phi), y = way * std::sin(phi);
        sum += w[k * 65 + i] * std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
      }
    }
    EXPECT_NEAR(sum, 2.0 * core::kPi / 3.0, 0.02) << sigma;
  }
}

}  // namespace
}  // namespace evenglow::tracer
