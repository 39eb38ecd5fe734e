#include "design/tolerance/sensitivity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/tolerance/distribution.h"
#include "tests/support/z_test.h"

namespace evenglow::design {
namespace {

struct Data {
  std::vector<std::vector<double>> parameters;
  std::vector<double> figure;
};

/// figure = 3 a - 2 b + noise (standard deviation 0.5); a and b of deviation 1 and 4, correlated; c does not vary.
Data data_of(int count, std::uint64_t index) {
  core::PhotonRng rng({8, 0, 0}, index);
  Data data;
  for (int i = 0; i < count; ++i) {
    const double a = draw_normal(rng), b = 4.0 * (0.6 * a + 0.8 * draw_normal(rng));
    data.parameters.push_back({a, b, 7.0});
    data.figure.push_back(100.0 + 3.0 * a - 2.0 * b + 0.5 * draw_normal(rng));
  }
  return data;
}

/// Many regressions: unbiased, and their errors are those that the spread of the regressions shows. False alarm 1e-3.
TEST(Sensitivity, FindsTheEffectsOfCorrelatedParameters) {
  constexpr int kRuns = 500;
  double z_sum[2] = {}, z_squares[2] = {};
  for (int run = 0; run < kRuns; ++run) {
    const Data data = data_of(80, static_cast<std::uint64_t>(run));
    const auto s = sensitivity(data.parameters, data.figure);
    ASSERT_TRUE(s);
    double squares[2] = {}, means[2] = {};
    for (const auto& row : data.parameters)
      for (int p = 0; p < 2; ++p) means[p] += row[static_cast<std::size_t>(p)] / 80.0;
    for (const auto& row : data.parameters)
      for (int p = 0; p < 2; ++p) squares[p] += std::pow(row[static_cast<std::size_t>(p)] - means[p], 2) / 79.0;
    const double slope[2] = {3.0, -2.0};
    for (int p = 0; p < 2; ++p) {
      const core::Estimate& e = s->effects[static_cast<std::size_t>(p)];
      const double z = (e.value - slope[p] * std::sqrt(squares[p])) / e.se;
      z_sum[p] += z;
      z_squares[p] += z * z;
    }
    EXPECT_EQ(s->effects[2].value, 0.0);
    EXPECT_EQ(s->effects[2].se, 0.0);
    EXPECT_NEAR(s->residual, 0.5, 0.25);
    EXPECT_GT(s->explained, 0.98);
  }
  for (int p = 0; p < 2; ++p) {
    EXPECT_LT(std::abs(z_sum[p]) / std::sqrt(kRuns), tests::z_limit(1e-3, 4));
    EXPECT_LT(std::abs(z_squares[p] / kRuns - 1.0) / std::sqrt(2.2 / kRuns), tests::z_limit(1e-3, 4));
  }
}

TEST(Sensitivity, IsNotToldWhereItCannotBe) {
  Data data = data_of(13, 1);
  EXPECT_FALSE(sensitivity(data.parameters, data.figure)) << "too few samples";
  data = data_of(80, 1);
  for (auto& row : data.parameters) row[2] = row[0] - row[1];
  EXPECT_FALSE(sensitivity(data.parameters, data.figure)) << "parameters that cannot be told apart";
  EXPECT_FALSE(sensitivity(std::vector<std::vector<double>>(80), data.figure)) << "no parameters";
}

}  // namespace
}  // namespace evenglow::design
