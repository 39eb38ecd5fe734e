#include "design/dots/discrepancy.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

SampleWindow random_window(std::size_t count, std::uint64_t seed) {
  core::PhotonRng rng({seed, 0, 0}, 0);
  SampleWindow window;
  for (std::size_t i = 0; i < count; ++i) {
    window.x.push_back(rng.uniform());
    window.y.push_back(rng.uniform());
  }
  return window;
}

/// The integral as a sum over n x n points.
double by_points(const SampleWindow& w, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n;
      double inside = 0.0;
      for (std::size_t k = 0; k < w.x.size(); ++k) inside += w.x[k] < x && w.y[k] < y;
      const double share = x * y * (1.0 + 0.5 * w.slope_x * (x - 1.0) + 0.5 * w.slope_y * (y - 1.0));
      sum += std::pow(inside / static_cast<double>(w.x.size()) - share, 2);
    }
  }
  return sum / (n * n);
}

TEST(Discrepancy, AgreesWithTheIntegral) {
  SampleWindow window = random_window(40, 5);
  EXPECT_NEAR(squared_discrepancy(window), by_points(window, 800), 1e-5);
  window.slope_x = 0.4;
  window.slope_y = -0.3;
  EXPECT_NEAR(squared_discrepancy(window), by_points(window, 800), 1e-5);
}

TEST(Discrepancy, OfChanceIsItsExpectation) {
  // 400 windows of 50 dots. The spread of D of one window is near its mean, so the standard error is 5 %; 4 of them.
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) sum += squared_discrepancy(random_window(50, seed));
  EXPECT_NEAR(sum / 400.0 / random_discrepancy(50.0), 1.0, 0.2);
}

TEST(Discrepancy, CountsWindowsWithinThePublishedLimit) {
  EXPECT_NEAR(accepted_discrepancy(100.0), 0.13 * std::pow(100.0, -1.15), 1e-12);
  SampleWindow even;  // an additive recurrence of low discrepancy
  for (int k = 1; k <= 400; ++k) {
    even.x.push_back(std::fmod(0.7548776662466927 * k, 1.0));
    even.y.push_back(std::fmod(0.5698402909980532 * k, 1.0));
  }
  SampleWindow crowded = random_window(400, 1);
  for (double& x : crowded.x) x *= 0.8;
  const DiscrepancyStatistics statistics = discrepancy_statistics({even, crowded}, 1);
  EXPECT_EQ(statistics.windows, 2u);
  EXPECT_EQ(statistics.accepted, 1u);
  EXPECT_EQ(statistics.mean_count, 400.0);
}

}  // namespace
}  // namespace evenglow::tests
