#include "design/tolerance/noise_shift.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/problem/merit.h"
#include "design/tolerance/distribution.h"
#include "design/tolerance/figures.h"
#include "tests/support/z_test.h"

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(20, 10, 0.0, 0.0, 20.0, 10.0);

/// `batches` batches of an even map of 1, each cell with a normal noise of `noise`.
core::Tally noisy(std::size_t batches, double noise, std::uint64_t index) {
  core::PhotonRng rng({12, 0, 0}, index);
  core::Tally tally(kGrid.size());
  for (std::size_t b = 0; b < batches; ++b) {
    std::vector<double> sums(kGrid.size());
    for (double& value : sums) value = 1.0 + noise * draw_normal(rng);
    tally.add_batch(std::move(sums));
  }
  return tally;
}

/// Against traces of 4 batches made on their own: how much lower their uniformity is than that of 4000. False alarm
/// 1e-3.
TEST(NoiseShift, IsThatOfShortTracesAgainstALongOne) {
  constexpr double kNoise = 0.05;
  const auto nine = static_cast<std::size_t>(figure_index("uniformity_9"));
  const core::Tally reference = noisy(4000, kNoise, 1);
  const auto shift = noise_shift(reference, kGrid, 4000000, 4000)[nine];
  const auto uniformity = [](const core::Tally& tally) {
    core::CellField field(kGrid, 0.0);
    for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = tally.total(i).value;
    return uniformity_9(field);
  };
  const double whole = uniformity(reference);
  double sum = 0.0, squares = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    const double d = uniformity(noisy(4, kNoise, static_cast<std::uint64_t>(run) + 10)) - whole;
    sum += d;
    squares += d * d;
  }
  const double mean = sum / kRuns, se = std::sqrt((squares / kRuns - mean * mean) / kRuns);
  EXPECT_LT(shift.value, -5.0 * shift.se) << "noise makes it lower";
  EXPECT_LT(std::abs(shift.value - mean) / std::hypot(se, shift.se), tests::two_sided_z(1e-3));
}

TEST(NoiseShift, IsUnknownFromTooShortAReference) {
  const auto nine = static_cast<std::size_t>(figure_index("uniformity_9"));
  EXPECT_TRUE(std::isnan(noise_shift(noisy(100, 0.05, 3), kGrid, 1000, 400)[nine].value));
  EXPECT_FALSE(std::isnan(noise_shift(noisy(100, 0.05, 3), kGrid, 1000, 250)[nine].value));
  EXPECT_EQ(noise_shift(noisy(100, 0.05, 3), kGrid, 1000, 250)[0].value, 0.0);
}

}  // namespace
}  // namespace evenglow::design
