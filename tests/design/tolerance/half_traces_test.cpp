#include "design/tolerance/half_traces.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/problem/merit.h"
#include "design/tolerance/distribution.h"
#include "design/tolerance/population.h"
#include "tests/support/z_test.h"

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(20, 10, 0.0, 0.0, 20.0, 10.0);

/// 10 batches of a map that falls by `tilt` along x, each cell with a normal noise.
core::Tally noisy(double tilt, double noise, std::uint64_t index) {
  core::PhotonRng rng({12, 0, 0}, index);
  core::Tally tally(kGrid.size());
  for (int b = 0; b < 10; ++b) {
    std::vector<double> sums(kGrid.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = 1.0 - tilt * static_cast<double>(i % 20) / 19.0 + noise * draw_normal(rng);
    tally.add_batch(std::move(sums));
  }
  return tally;
}

core::CellField whole(const core::Tally& tally) {
  core::CellField field(kGrid, 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = tally.total(i).value;
  return field;
}

/// Many traces of one backlight: no spread but noise. An even map, where all spots are alike, and one whose least and
/// greatest spots are far apart. Seeds fixed; false alarm 1e-3.
TEST(HalfTraces, TellTheNoiseOfUniformitiesAndItsShift) {
  for (const double tilt : {0.0, 0.3}) {
    const double truth = uniformity_9(whole(noisy(tilt, 0.0, 0)));
    constexpr int kTraces = 2000;
    std::vector<std::array<double, 2>> halves;
    std::vector<double> wholes;
    for (int t = 0; t < kTraces; ++t) {
      const core::Tally tally = noisy(tilt, 0.1, static_cast<std::uint64_t>(t) + 1);
      halves.push_back(half_traces(tally, kGrid).nine);
      wholes.push_back(uniformity_9(whole(tally)));
    }
    const HalfNoise noise = noise_of_halves(halves, wholes);
    double mean = 0.0, seen = 0.0, told = 0.0;
    for (const double w : wholes) mean += w / kTraces;
    for (std::size_t t = 0; t < wholes.size(); ++t) {
      seen += (wholes[t] - mean) * (wholes[t] - mean) / kTraces;
      told += noise.se[t] * noise.se[t] / kTraces;
    }
    // The variance of both to about 2 and 3 %; of an even map the noise of a half is not quite sqrt(2) as large.
    EXPECT_NEAR(told / seen, 1.0, tests::two_sided_z(1e-3) * std::sqrt(4.0 / kTraces) + 0.05) << tilt;
    const double se = std::hypot(noise.shift.se, std::sqrt(seen / kTraces));
    EXPECT_NEAR(noise.shift.value, mean - truth, tests::two_sided_z(1e-3) * se + 0.003 * tilt) << tilt;
    if (tilt == 0.0) {
      EXPECT_LT(mean - truth, -0.02) << "or there was no shift to tell";
    }
  }
}

TEST(HalfTraces, AreTheEvenAndTheOddBatches) {
  core::Tally tally(kGrid.size());
  std::vector<double> even(kGrid.size(), 1.0), odd(kGrid.size(), 1.0);
  for (std::size_t i = 0; i < odd.size(); ++i) odd[i] = i % 20 < 10 ? 1.0 : 0.5;
  for (int b = 0; b < 2; ++b) {
    tally.add_batch(even);
    tally.add_batch(odd);
  }
  const HalfTraces halves = half_traces(tally, kGrid);
  EXPECT_EQ(halves.nine[0], 1.0);
  EXPECT_NEAR(halves.nine[1], 0.5, 1e-12);
  EXPECT_NEAR(halves.thirteen[1], 0.5, 1e-12);
}

}  // namespace
}  // namespace evenglow::design
