#include "design/problem/merit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "design/problem/pair_statistic.h"

/// The noise-corrected RMS on maps whose RMS is known. Seeds fixed; what each test may raise by chance is said at it.
namespace evenglow::design {
namespace {

constexpr int kNx = 24, kNy = 12, kCells = kNx * kNy;

/// A smooth pattern of mean 1 and of exactly this standard deviation.
std::vector<double> pattern(double rms) {
  std::vector<double> p(kCells);
  double mean = 0.0, squares = 0.0;
  for (int i = 0; i < kCells; ++i) {
    const double x = (i % kNx + 0.5) / kNx, y = (i / kNx + 0.5) / kNy;
    p[static_cast<std::size_t>(i)] =
        std::cos(core::kPi * x) + 0.5 * std::cos(2.0 * core::kPi * y) + 0.3 * std::sin(7.0 * x * y);
    mean += p[static_cast<std::size_t>(i)] / kCells;
  }
  for (double& v : p) {
    v -= mean;
    squares += v * v / kCells;
  }
  for (double& v : p) v = 1.0 + v * rms / std::sqrt(squares);
  return p;
}

struct Noise {
  double photons_a_cell = 100.0;  ///< in each batch
  double common = 0.0;            ///< relative noise of a whole batch that all cells share
  double wave = 0.0;  ///< relative noise of each batch in one smooth mode across the map: neighboring cells correlate
};

core::Tally draw(const std::vector<double>& p, const Noise& noise, int batches, std::mt19937_64& generator) {
  core::Tally tally(p.size());
  std::normal_distribution<double> normal;
  for (int b = 0; b < batches; ++b) {
    const double level = 1.0 + noise.common * normal(generator), wave = noise.wave * normal(generator);
    std::vector<double> sums(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double x = (static_cast<int>(i) % kNx + 0.5) / kNx;
      std::poisson_distribution<int> count(noise.photons_a_cell * p[i] * level *
                                           (1.0 + wave * std::cos(3.0 * core::kPi * x)));
      sums[i] = count(generator);
    }
    tally.add_batch(std::move(sums));
  }
  return tally;
}

struct Pulls {
  double mean = 0.0, width = 0.0, root_of_mean = 0.0, noise = 0.0;
};

Pulls pulls(double rms, const Noise& noise, int repetitions) {
  const std::vector<double> p = pattern(rms);
  std::mt19937_64 generator(20260101);
  double sum = 0.0, squares = 0.0, estimates = 0.0, plain = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    const Evenness e = evenness(draw(p, noise, 100, generator));
    const core::Estimate s = signed_square(e.rms_corrected);
    const double pull = (s.value - rms * rms) / s.se;
    sum += pull;
    squares += pull * pull;
    estimates += s.value / repetitions;
    plain += e.rms / repetitions;
  }
  const double mean = sum / repetitions;
  return {mean, std::sqrt(squares / repetitions - mean * mean),
          std::copysign(std::sqrt(std::abs(estimates)), estimates), plain};
}

/// 400 repetitions: the width of unit pulls has a standard error of 0.035, so 0.1 is 2.8 of them (false alarm 0.005
/// each); the mean is held to 5 standard errors.
class EvennessPulls : public testing::TestWithParam<double> {};

TEST_P(EvennessPulls, HaveUnitWidthAndNoBias) {
  const double rms = GetParam();
  const Pulls result = pulls(rms, {}, 400);
  std::printf("rms %.3f: plain %.5f, corrected %.5f, pull %.3f +- %.3f\n", rms, result.noise, result.root_of_mean,
              result.mean, result.width);
  EXPECT_NEAR(result.width, 1.0, 0.1);
  EXPECT_LT(std::abs(result.mean), 0.25);
  EXPECT_GT(result.noise, rms);
  if (rms > 0.0) {
    EXPECT_NEAR(result.root_of_mean, rms, 2e-4);  // 0.02 percentage points
  }
}
INSTANTIATE_TEST_SUITE_P(Rms, EvennessPulls, testing::Values(0.0, 0.003, 0.01, 0.03, 0.2));

/// Noise that all cells of a batch share drops out; noise that neighbors share is held by the error.
TEST(Evenness, CorrelatedNoise) {
  for (const Noise& noise : {Noise{100.0, 0.1, 0.0}, {100.0, 0.0, 0.02}}) {
    const Pulls result = pulls(0.01, noise, 400);
    std::printf("common %.2f wave %.2f: plain %.5f, corrected %.5f, pull %.3f +- %.3f\n", noise.common, noise.wave,
                result.noise, result.root_of_mean, result.mean, result.width);
    EXPECT_NEAR(result.width, 1.0, 0.1);
    EXPECT_NEAR(result.root_of_mean, 0.01, 2e-4);
  }
}

TEST(Evenness, PlainRmsIsThatOfTheMap) {
  const std::vector<double> p = pattern(0.03);
  core::Tally tally(p.size());
  for (int b = 0; b < 5; ++b) tally.add_batch(p);
  const Evenness e = evenness(tally);
  EXPECT_NEAR(e.rms, 0.03, 1e-12);
  EXPECT_NEAR(e.rms_corrected.value, 0.03, 1e-12);  // no noise to take off
  EXPECT_NEAR(e.rms_corrected.se, 0.0, 1e-9);
  EXPECT_NEAR(e.mean.value, 5.0, 1e-12);
}

/// Scores of any size: the unit drops out.
TEST(Evenness, DoesNotDependOnTheUnit) {
  std::mt19937_64 generator(4);
  const core::Tally tally = draw(pattern(0.02), {}, 20, generator);
  core::Tally scaled(tally.bins());
  for (std::size_t b = 0; b < tally.batches(); ++b) {
    std::vector<double> sums = tally.batch(b);
    for (double& v : sums) v *= 1e-7;
    scaled.add_batch(std::move(sums));
  }
  EXPECT_NEAR(evenness(tally).rms_corrected.value, evenness(scaled).rms_corrected.value, 1e-12);
  EXPECT_NEAR(evenness(tally).rms_corrected.se, evenness(scaled).rms_corrected.se, 1e-12);
}

TEST(Evenness, DarkMapsAndTooFewBatches) {
  core::Tally dark(4);
  for (int b = 0; b < 3; ++b) dark.add_batch({0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(evenness(dark).rms));
  EXPECT_TRUE(std::isnan(evenness(dark).rms_corrected.value));
  EXPECT_TRUE(std::isnan(evenness(dark).low) && std::isnan(evenness(dark).high));
  EXPECT_EQ(evenness(dark).mean.value, 0.0);
  core::Tally two(4);
  two.add_batch({1, 1, 1, 1});
  two.add_batch({1, 1, 1, 1});
  EXPECT_THROW(evenness(two), core::Error);
}

TEST(Uniformity, SpotsAtNineAndThirteenPoints) {
  core::CellField field(core::CellGrid::over(100, 50, 3.0, 1.0, 103.0, 51.0), 10.0);
  EXPECT_DOUBLE_EQ(uniformity_9(field), 1.0);
  EXPECT_DOUBLE_EQ(uniformity_13(field), 1.0);
  const auto darken = [&](double u, double v, double value) {
    for (int iy = 0; iy < 50; ++iy) {
      for (int ix = 0; ix < 100; ++ix) {
        const double x = field.grid.center_x(ix) - 3.0 - 100.0 * u, y = field.grid.center_y(iy) - 1.0 - 50.0 * v;
        if (std::hypot(x, y) < 6.0) field.values[static_cast<std::size_t>(iy * 100 + ix)] = value;
      }
    }
  };
  darken(0.3, 0.7, 8.0);  // one of the thirteen only
  EXPECT_DOUBLE_EQ(uniformity_9(field), 1.0);
  EXPECT_DOUBLE_EQ(uniformity_13(field), 0.8);
  darken(0.9, 0.1, 5.0);
  EXPECT_DOUBLE_EQ(uniformity_9(field), 0.5);
  darken(0.5, 0.5, 20.0);
  EXPECT_DOUBLE_EQ(center_luminance(field), 20.0);
  EXPECT_DOUBLE_EQ(uniformity_9(field), 0.25);
  EXPECT_TRUE(std::isnan(uniformity_9(core::CellField(field.grid, 0.0))));
}

/// A notch: what a mask takes out of the display is no part of a spot, nor its center a spot of its own.
TEST(Uniformity, CellsThatDoNotCountAreInNoSpot) {
  core::CellField field(core::CellGrid::over(100, 50, 0.0, 0.0, 100.0, 50.0), 10.0);
  core::CellField target(field.grid, 1.0);
  core::Tally tally(field.values.size());
  for (int iy = 0; iy < 50; ++iy) {
    for (int ix = 0; ix < 100; ++ix) {
      const auto cell = static_cast<std::size_t>(iy * 100 + ix);
      if (ix > 84 && iy < 25) field.values[cell] = target.values[cell] = 0.0;  // a spot, and half of that at 0.9, 0.5
    }
  }
  for (int b = 0; b < 3; ++b) tally.add_batch(std::vector<double>(field.values));
  EXPECT_EQ(uniformity_9(field), 0.0);
  EXPECT_EQ(counted_only(field, {}).values, field.values);
  const core::CellField counted = counted_only(field, target);
  EXPECT_DOUBLE_EQ(uniformity_9(counted), 1.0);
  EXPECT_DOUBLE_EQ(uniformity_13(counted), 1.0);
  EXPECT_TRUE(std::isnan(uniformity_spots(counted)[2].luminance));
  EXPECT_DOUBLE_EQ(uniformity_spots(counted)[5].luminance, 10.0);
  EXPECT_EQ(spot_errors(tally, target).uniformity_9, 0.0);
}

// The variance of 400 repetitions is known to 7 % (the error to 3.5 %); 15 % is more than four of its errors for each
// of the three figures: a false alarm in fewer than 1 of 10 000 seeds.
TEST(Uniformity, ErrorsAgreeWithTheScatterOfRepetitions) {
  const core::CellGrid grid = core::CellGrid::over(kNx, kNy, 0.0, 0.0, 24.0, 12.0);
  const std::vector<double> p = pattern(0.2);
  std::mt19937_64 generator(41);
  constexpr int kTimes = 400;
  double sum[3] = {}, squares[3] = {}, told[3] = {};
  for (int k = 0; k < kTimes; ++k) {
    const core::Tally tally = draw(p, {400.0}, 20, generator);
    core::CellField total(grid, 0.0);
    for (std::size_t i = 0; i < total.values.size(); ++i) total.values[i] = tally.total(i).value;
    const SpotErrors se = spot_errors(tally, core::CellField(grid, 1.0));
    const double value[3] = {uniformity_9(total), uniformity_13(total), center_luminance(total)};
    const double error[3] = {se.uniformity_9, se.uniformity_13, se.center};
    for (int j = 0; j < 3; ++j) {
      sum[j] += value[j] / kTimes;
      squares[j] += value[j] * value[j] / kTimes;
      told[j] += error[j] * error[j] / kTimes;
    }
  }
  for (int j = 0; j < 3; ++j) {
    const double scatter = std::sqrt((squares[j] - sum[j] * sum[j]) * kTimes / (kTimes - 1.0));
    EXPECT_NEAR(std::sqrt(told[j]) / scatter, 1.0, 0.15) << j;
  }
}

TEST(Merit, SpotsAreThoseOfTheUniformities) {
  core::CellField field(core::CellGrid::over(60, 30, 5.0, 2.0, 125.0, 62.0), 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = 100.0 + static_cast<double>(i * 7919 % 997);
  const std::vector<SpotValue> spots = uniformity_spots(field);
  ASSERT_EQ(spots.size(), 13U);
  EXPECT_NEAR(spots[0].x, 17.0, 1e-9);
  EXPECT_NEAR(spots[0].y, 8.0, 1e-9);
  EXPECT_NEAR(spots[12].x, 89.0, 1e-9);
  EXPECT_NEAR(spots[12].y, 44.0, 1e-9);
  EXPECT_EQ(spots[4].luminance, center_luminance(field));
  const auto uniformity = [&](std::size_t count) {
    double low = 1e9, high = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      low = std::min(low, spots[i].luminance);
      high = std::max(high, spots[i].luminance);
    }
    return low / high;
  };
  EXPECT_EQ(uniformity(9), uniformity_9(field));
  EXPECT_EQ(uniformity(13), uniformity_13(field));
}

}  // namespace
}  // namespace evenglow::design
