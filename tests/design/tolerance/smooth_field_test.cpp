#include "design/tolerance/smooth_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/z_test.h"

namespace evenglow::design {
namespace {

/// Over many fields: mean 0, variance 1, correlation exp(-r^2 / (2 length^2)). Seed fixed; false alarm 1e-3.
TEST(SmoothField, HasItsVarianceAndCorrelation) {
  const auto grid = core::CellGrid::over(5, 2, 0.0, 0.0, 50.0, 20.0);  // centers 10 mm apart
  constexpr int kFields = 4000;
  constexpr double kLength = 12.0;
  std::vector<double> mean, variance, near, far, up;
  for (int i = 0; i < kFields; ++i) {
    core::PhotonRng rng({5, 0, 0}, static_cast<std::uint64_t>(i));
    const core::CellField f = smooth_field(grid, kLength, rng);
    mean.push_back(f.values[0]);
    variance.push_back(f.values[0] * f.values[0]);
    near.push_back(f.values[0] * f.values[1]);
    far.push_back(f.values[0] * f.values[3]);
    up.push_back(f.values[0] * f.values[5]);
  }
  const auto z = [](const std::vector<double>& values, double expected) {
    double sum = 0.0, squares = 0.0;
    for (const double v : values) {
      sum += v;
      squares += v * v;
    }
    const double n = kFields, m = sum / n;
    return (m - expected) / std::sqrt((squares / n - m * m) / (n - 1.0));
  };
  const auto correlation = [](double r) { return std::exp(-0.5 * r * r / (kLength * kLength)); };
  const double limit = tests::z_limit(1e-3, 5);
  EXPECT_LT(std::abs(z(mean, 0.0)), limit);
  EXPECT_LT(std::abs(z(variance, 1.0)), limit);
  EXPECT_LT(std::abs(z(near, correlation(10.0))), limit);
  EXPECT_LT(std::abs(z(far, correlation(30.0))), limit);
  EXPECT_LT(std::abs(z(up, correlation(10.0))), limit);
}

}  // namespace
}  // namespace evenglow::design
