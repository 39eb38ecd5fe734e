#include "design/dots/fourier_sums.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

TEST(FourierSums, AreTheSumsThatTheyAreDefinedAs) {
  const std::vector<double> x = {0.1, 1.7, 2.2, 3.9};
  const std::vector<double> y = {0.4, 0.2, 2.8, 1.1};
  const std::vector<double> w = {1.0, 2.0, 0.5, 3.0};
  const FrequencyRow fx{-0.5, 0.25, 5};
  const FrequencyRow fy{0.1, 0.3, 3};
  const auto sums = fourier_sums(x, y, w, fx, fy);
  ASSERT_EQ(sums.rows(), 3);
  ASSERT_EQ(sums.cols(), 5);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 5; ++column) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double turns = (fx.first + column * fx.step) * x[i] + (fy.first + row * fy.step) * y[i];
        sum += w[i] * std::polar(1.0, -2.0 * std::numbers::pi * turns);
      }
      EXPECT_NEAR(sums(row, column).real(), sum.real(), 2e-5);
      EXPECT_NEAR(sums(row, column).imag(), sum.imag(), 2e-5);
    }
  }
}

// A square lattice of pitch 2: all dots in step at multiples of 1/2, none at 1/4 of an even number of dots.
TEST(FourierSums, OfALatticePeakAtItsFrequency) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      x.push_back(2.0 * i);
      y.push_back(2.0 * j);
    }
  }
  const auto sums = fourier_sums(x, y, {}, {0.0, 0.25, 3}, {0.0, 0.5, 2});
  EXPECT_NEAR(std::abs(sums(0, 0)), 64.0, 1e-3);
  EXPECT_NEAR(std::abs(sums(0, 1)), 0.0, 1e-3);
  EXPECT_NEAR(std::abs(sums(0, 2)), 64.0, 1e-3);
  EXPECT_NEAR(std::abs(sums(1, 2)), 64.0, 1e-3);
}

}  // namespace
}  // namespace evenglow::design
