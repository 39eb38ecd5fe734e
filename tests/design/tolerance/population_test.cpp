#include "design/tolerance/population.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/tolerance/distribution.h"
#include "tests/support/z_test.h"

/// Synthetic samples; seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::design {
namespace {

/// `count` samples of a normal population (mean 10), each with a noise of its own size about `noise`.
std::vector<core::Estimate> samples_of(std::size_t count, double spread, double noise, std::uint64_t index) {
  core::PhotonRng rng({31, 0, 0}, index);
  std::vector<core::Estimate> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double se = noise * (0.5 + rng.uniform());
    samples.push_back({10.0 + spread * draw_normal(rng) + se * draw_normal(rng), se});
  }
  return samples;
}

/// Mean over many runs of the variance without noise (signed), and how often its interval holds the truth.
TEST(Population, VarianceWithoutNoiseIsUnbiasedAndItsIntervalHolds) {
  for (const double spread : {0.0, 0.5, 2.0}) {
    constexpr int kRuns = 3000;
    double sum = 0.0, squares = 0.0, held = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      const Population p = population_of(samples_of(60, spread, 1.0, static_cast<std::uint64_t>(run)));
      const double variance = p.spread.value * std::abs(p.spread.value);
      sum += variance;
      squares += variance * variance;
      held += p.spread_low <= spread && spread <= p.spread_high;
    }
    const double mean = sum / kRuns, se = std::sqrt((squares / kRuns - mean * mean) / kRuns);
    EXPECT_LT(std::abs(mean - spread * spread) / se, tests::z_limit(1e-3, 3)) << spread;
    EXPECT_GT(held / kRuns, 0.90) << spread;  // 95 % but for what 60 samples leave of normality
    EXPECT_LT(held / kRuns, 0.98) << spread;
  }
}

TEST(Population, NoiseInCommonIsNotTakenOff) {
  const auto samples = samples_of(200, 0.5, 1.0, 1);
  const Population common = population_of(samples, true);
  EXPECT_EQ(common.spread.value, common.seen);
  EXPECT_LT(population_of(samples).spread.value, common.seen);
}

TEST(Population, TellsItsOrderStatistics) {
  const Population p = population_of({{3, 0}, {1, 0}, {2, 0}, {10, 0}});
  EXPECT_EQ(p.least, 1.0);
  EXPECT_EQ(p.median, 2.5);
  EXPECT_EQ(p.greatest, 10.0);
  EXPECT_EQ(p.mean.value, 4.0);
  EXPECT_NEAR(p.seen, std::sqrt(50.0 / 3.0), 1e-12);
  EXPECT_NEAR(p.mean.se, p.seen / 2.0, 1e-12);
}

TEST(Population, SamplesWithoutNoiseHaveTheSpreadOfThePopulation) {
  const auto samples = samples_of(400, 1.0, 1.0, 4);
  const Population p = population_of(samples);
  const auto values = without_noise(samples, p, 0.25);
  double mean = 0.0, variance = 0.0;
  for (const double v : values) mean += v / 400.0;
  for (const double v : values) variance += (v - mean) * (v - mean) / 399.0;
  EXPECT_NEAR(mean, p.mean.value - 0.25, 1e-9);
  EXPECT_NEAR(std::sqrt(variance), p.spread.value, 1e-9);
  const auto noise = samples_of(50, 0.0, 1.0, 12);
  Population none = population_of(noise);
  none.spread.value = -0.1;
  for (const double v : without_noise(noise, none)) EXPECT_EQ(v, none.mean.value);
}

}  // namespace
}  // namespace evenglow::design
