#include "design/tolerance/distribution.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/config_reading.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kDraws = 200000;

/// Mean and variance of many draws against those expected; `kurtosis` m4 / m2^2 of the distribution.
void check_moments(const Distribution& d, double nominal, double mean, double variance, double kurtosis) {
  core::PhotonRng rng({20261122, 0, 0}, 0);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = d.draw(rng, nominal);
    ASSERT_GE(value, d.least(nominal));
    ASSERT_LE(value, d.greatest(nominal));
    sum += value - mean;
    squares += (value - mean) * (value - mean);
  }
  const double limit = tests::z_limit(1e-3, 2);
  EXPECT_LT(std::abs(sum / kDraws) / std::sqrt(variance / kDraws), limit);
  EXPECT_LT(std::abs(squares / kDraws - variance) / (variance * std::sqrt((kurtosis - 1.0) / kDraws)), limit);
}

TEST(Distribution, NormalIsCutAtThreeDeviations) {
  check_moments({Distribution::Kind::normal, 0.2, {}, {}}, 5.0, 5.0, 0.04 * kCutDeviation * kCutDeviation, 2.85);
  const double c = kDistributionCut, density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::acos(-1.0));
  EXPECT_NEAR(kCutDeviation, std::sqrt(1.0 - 2.0 * c * density / std::erf(c / std::sqrt(2.0))), 1e-5);
}

TEST(Distribution, UniformHasItsHalfWidthAndItsOwnMean) {
  check_moments({Distribution::Kind::uniform, 3.0, -1.0, {}}, 5.0, -1.0, 3.0, 1.8);
}

TEST(Distribution, ChoicesComeByTheirWeights) {
  Distribution d{Distribution::Kind::choices, 0.0, {}, {0.9, 1.0, 1.2}, {0.25, 0.75, 1.0}};
  core::PhotonRng rng({7, 0, 0}, 0);
  std::array<double, 3> hits{};
  for (int i = 0; i < kDraws; ++i) {
    const double value = d.draw(rng, 1.0);
    hits[value == 0.9 ? 0 : value == 1.0 ? 1 : 2] += 1.0;
  }
  const std::array<double, 3> odds = {0.25, 0.5, 0.25};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(std::abs(tests::binomial_z(hits[i], kDraws, odds[i])), tests::z_limit(1e-3, 3));
  EXPECT_EQ(d.least(1.0), 0.9);
  EXPECT_EQ(d.greatest(1.0), 1.2);
}

core::Lines faults(const std::string& map, Distribution* read = nullptr) {
  return core::faults_of("v: " + map + "\n", [&](const core::ConfigNode& root) {
    const Distribution d = read_distribution(root.map("v", ""), 10.0);
    if (read != nullptr) *read = d;
  });
}

TEST(Distribution, IsReadFromOneOfThreeKeys) {
  Distribution d;
  EXPECT_THAT(faults("{normal: 2, mean: 3}", &d), IsEmpty());
  EXPECT_EQ(d, (Distribution{Distribution::Kind::normal, 2.0, 3.0, {}}));
  EXPECT_THAT(faults("{uniform: 1}", &d), IsEmpty());
  EXPECT_EQ(d, (Distribution{Distribution::Kind::uniform, 1.0, {}, {}}));
  EXPECT_THAT(faults("{choices: [1, 2], weights: [1, 3]}", &d), IsEmpty());
  EXPECT_THAT(d.shares, ElementsAre(0.25, 1.0));
  EXPECT_THAT(faults("{choices: [1, 2]}", &d), IsEmpty());
  EXPECT_THAT(d.shares, ElementsAre(0.5, 1.0));
}

TEST(Distribution, WhatIsWrongIsTold) {
  EXPECT_THAT(faults("{}"), ElementsAre(HasSubstr("must have one of normal, uniform and choices, got none")));
  EXPECT_THAT(faults("{normal: 1, uniform: 2}"), ElementsAre(HasSubstr("got several")));
  EXPECT_THAT(faults("{normal: 11}"), ElementsAre(HasSubstr("v.normal: must lie in [0, 10]")));
  EXPECT_THAT(faults("{normal: -1}"), ElementsAre(HasSubstr("v.normal")));
  EXPECT_THAT(faults("{choices: [1, 2], weights: [1]}"), ElementsAre(HasSubstr("for each of the 2 choices, got 1")));
  EXPECT_THAT(faults("{choices: [1, 2], weights: [0, 0]}"), ElementsAre(HasSubstr("must not all be 0")));
  EXPECT_THAT(faults("{choices: [1, 2], mean: 1}"), ElementsAre(HasSubstr("must not stand beside choices")));
  EXPECT_THAT(faults("{normal: 1, weights: [1]}"), ElementsAre(HasSubstr("belongs to choices")));
}

}  // namespace
}  // namespace evenglow::design
