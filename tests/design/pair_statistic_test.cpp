#include "design/problem/pair_statistic.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

BatchProducts products(const std::vector<double>& y) {
  BatchProducts h(y.size());
  for (std::size_t b = 0; b < y.size(); ++b) {
    for (std::size_t c = 0; c < b; ++c) h.at(b, c) = y[b] * y[c];
  }
  return h;
}

/// ((sum)^2 - sum of squares) / (B (B - 1)).
TEST(PairStatistic, IsTheMeanOverPairs) {
  const core::Estimate square = pair_statistic(products({1.0, 2.0, 4.0, -1.0}));
  EXPECT_NEAR(square.value, (36.0 - 22.0) / 12.0, 1e-14);
  EXPECT_NEAR(pair_statistic(products({3.0, 3.0, 3.0})).value, 9.0, 1e-14);
  EXPECT_NEAR(pair_statistic(products({3.0, 3.0, 3.0})).se, 0.0, 1e-12);
  EXPECT_THROW(pair_statistic(BatchProducts(2)), core::Error);
}

/// Unit pulls whether the noise hides the value or not. 1000 repetitions: the width has a standard error of 0.022 for
/// normal pulls, and 0.1 is more than 4 of them; where the square is all noise its distribution is skew: 0.3. A bias is
/// held to 4 standard errors.
TEST(PairStatistic, HasUnitPullsAndNoBias) {
  std::mt19937_64 random(3);
  for (const double mean : {0.1, 5.0}) {
    constexpr int kRepetitions = 1000, kBatches = 200;
    double sum = 0.0, squares = 0.0, values = 0.0;
    for (int i = 0; i < kRepetitions; ++i) {
      std::normal_distribution<double> noise(mean, 1.0);
      std::vector<double> y(kBatches);
      for (double& v : y) v = noise(random);
      const core::Estimate square = pair_statistic(products(y));
      const double pull = (square.value - mean * mean) / square.se;
      sum += pull / kRepetitions;
      squares += pull * pull / kRepetitions;
      values += square.value / kRepetitions;
    }
    EXPECT_NEAR(std::sqrt(squares - sum * sum), 1.0, mean > 1.0 ? 0.1 : 0.3) << mean;
    const double spread = std::sqrt(4.0 * mean * mean / kBatches + 2.0 / (kBatches * (kBatches - 1.0)));
    EXPECT_NEAR(values, mean * mean, 4.0 * spread / std::sqrt(kRepetitions)) << mean;
  }
}

TEST(PairStatistic, SignedRoot) {
  EXPECT_DOUBLE_EQ(signed_root(4.0, 0.4).value, 2.0);
  EXPECT_DOUBLE_EQ(signed_root(4.0, 0.4).se, 0.5 * std::sqrt(0.4 / 9.0));
  EXPECT_NEAR(signed_root(4.0, 0.004).se, 0.001, 1e-6);
  EXPECT_DOUBLE_EQ(signed_root(-4.0, 0.4).value, -2.0);
  EXPECT_NEAR(signed_root(0.0, 0.04).se, 0.893 * 0.2, 1e-4);
  EXPECT_EQ(signed_root(0.0, 0.0).se, 0.0);
}

/// Roots of squares of mean m and unit error: their pulls stay within what the header tells. 20,000 draws know a width
/// to 1 %.
TEST(PairStatistic, ErrorsOfRootsAreThoseOfTheirScatter) {
  std::mt19937_64 random(8);
  const auto width_of = [&](double mean) {
    std::normal_distribution<double> square(mean, 1.0);
    double sum = 0.0, squares = 0.0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
      const core::Estimate root = signed_root(square(random), 1.0);
      const double pull = (root.value - std::sqrt(mean)) / root.se;
      sum += pull / kDraws;
      squares += pull * pull / kDraws;
    }
    return std::sqrt(squares - sum * sum);
  };
  EXPECT_NEAR(width_of(0.0), 1.32, 0.05);
  EXPECT_NEAR(width_of(1.0), 1.08, 0.05);
  EXPECT_NEAR(width_of(3.0), 0.78, 0.05);
  EXPECT_NEAR(width_of(20.0), 0.97, 0.05);
}

TEST(PairStatistic, SquareAndRootTellTheSame) {
  for (const double square : {-4e-4, -6e-5, -1e-6, 0.0, 2e-6, 6e-5, 7e-5, 3e-4}) {
    const core::Estimate again = signed_square(signed_root(square, 5e-5));
    EXPECT_NEAR(again.value, square, 1e-15);
    EXPECT_NEAR(again.se, 5e-5, 1e-15) << square;
  }
}

}  // namespace
}  // namespace evenglow::design
