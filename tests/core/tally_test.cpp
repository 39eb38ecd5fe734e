#include "core/montecarlo/tally.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/z_test.h"

namespace evenglow::core {
namespace {

TEST(Tally, TotalsAndErrorsByHand) {
  Tally tally(2);
  tally.add_batch({1.0, 10.0});
  tally.add_batch({3.0, 10.0});
  tally.add_batch({5.0, 10.0});
  EXPECT_EQ(tally.bins(), 2U);
  EXPECT_EQ(tally.batches(), 3U);
  EXPECT_EQ(tally.batch(1)[0], 3.0);
  EXPECT_DOUBLE_EQ(tally.total(0).value, 9.0);
  EXPECT_DOUBLE_EQ(tally.total(0).se, std::sqrt(3.0 * 4.0));  // sample variance 4, three batches
  EXPECT_DOUBLE_EQ(tally.totals()[1].value, 30.0);
  EXPECT_EQ(tally.totals()[1].se, 0.0);
}

TEST(Tally, WeightedTotalKeepsCorrelations) {
  Tally tally(2);
  for (const double x : {1.0, 2.0, 6.0}) tally.add_batch({x, 10.0 - x});
  EXPECT_DOUBLE_EQ(tally.weighted_total({1.0, 1.0}).value, 30.0);
  EXPECT_EQ(tally.weighted_total({1.0, 1.0}).se, 0.0);
  EXPECT_DOUBLE_EQ(tally.weighted_total({1.0, -1.0}).se, 2.0 * tally.total(0).se);
}

TEST(Tally, OneBatchHasNoSpread) {
  Tally tally(1);
  tally.add_batch({4.0});
  EXPECT_EQ(tally.total(0).value, 4.0);
  EXPECT_EQ(tally.total(0).se, 0.0);
}

TEST(Tally, RefusesWrongSizes) {
  Tally tally(2);
  EXPECT_THROW(tally.add_batch({1.0}), Error);
  tally.add_batch({1.0, 2.0});
  EXPECT_THROW(tally.weighted_total({1.0}), Error);
}

/// Pulls of 4000 tallies of 50 batches: of unit width (Student's t of 49 degrees: 1.0213). False alarm 1e-3.
TEST(Tally, StandardErrorIsTheSpreadOfTotals) {
  std::mt19937_64 generator(3);
  std::poisson_distribution<int> counts(20.0);
  constexpr int kRepetitions = 4000;
  double squares = 0.0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    std::vector<double> batches(50);
    for (double& x : batches) x = counts(generator);
    const Estimate total = total_of_batches(batches);
    squares += std::pow((total.value - 1000.0) / total.se, 2);
  }
  const double expected = 49.0 / 47.0;  // variance of t
  const double z = (squares / kRepetitions - expected) / (expected * std::sqrt(2.2 / kRepetitions));
  EXPECT_LT(std::abs(z), tests::two_sided_z(1e-3));
}

TEST(Estimate, RatioToFirstOrder) {
  const Estimate r = ratio({6.0, 0.3}, {2.0, 0.2});
  EXPECT_DOUBLE_EQ(r.value, 3.0);
  EXPECT_DOUBLE_EQ(r.se, 3.0 * std::hypot(0.05, 0.1));
}

}  // namespace
}  // namespace evenglow::core
