#include "design/updaters/noise_aware_ratio_updater.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

core::CellField noise_field(const core::CellGrid& grid, double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  core::CellField field(grid, 0.0);
  for (double& value : field.values) value = normal(random);
  return field;
}

double rms_difference(const core::CellField& a, const core::CellField& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    squares += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  return std::sqrt(squares / static_cast<double>(a.values.size()));
}

core::CellField sum(core::CellField a, const core::CellField& b) {
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
  return a;
}

/// A smooth slope, a bright line along one edge, and a small bright spot.
core::CellField truth(const core::CellGrid& grid) {
  core::CellField field(grid, 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      double value = 0.8 * ix / grid.nx;
      if (iy == 0) value += 0.3;
      if (std::hypot(ix - 20, iy - 20) < 2.0) value += 1.0;
      field.values[static_cast<std::size_t>(iy * grid.nx + ix)] = value;
    }
  }
  return field;
}

const core::CellGrid kGrid = core::CellGrid::over(64, 40, 0, 0, 64, 40);

TEST(Denoise, LeavesANoiselessFieldAsItIs) {
  const core::CellField field = truth(kGrid);
  const core::CellField result = denoise(field, core::CellField(kGrid, 0.0)).field;
  EXPECT_LT(rms_difference(result, field), 1e-12);
}

TEST(Denoise, TakesOutMostOfPureNoise) {
  for (const unsigned seed : {1U, 3U, 5U, 7U, 9U, 11U}) {
    const core::CellField result = denoise(noise_field(kGrid, 0.2, seed), noise_field(kGrid, 0.2, seed + 1)).field;
    // What the coarsest band alone lets pass is 0.2 / (2 sqrt(pi) 11.2) = 0.005.
    EXPECT_LT(rms_difference(result, core::CellField(kGrid, 0.0)), 0.015) << seed;
  }
}

/// LEDs at the left edge leave their marks in one column of cells: bright all along, or bright and dark in turn. Square
/// windows alone see little of a column: those of 4 scales keep 0.79 and 0.34 of these two.
TEST(Denoise, FindsTheNarrowColumnBesideLeds) {
  core::CellField even(kGrid, 0.0), leds(kGrid, 0.0);
  for (int iy = 0; iy < kGrid.ny; ++iy) {
    even.values[static_cast<std::size_t>(iy * kGrid.nx)] = 0.15;
    leds.values[static_cast<std::size_t>(iy * kGrid.nx)] = iy % 8 < 4 ? 0.4 : -0.4;
  }
  const auto kept = [&](const core::CellField& field) {
    double product = 0.0, square = 0.0;
    for (const unsigned seed : {1U, 3U, 5U, 7U}) {
      const core::CellField result =
          denoise(sum(field, noise_field(kGrid, 0.1, seed)), noise_field(kGrid, 0.1, seed + 1)).field;
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        product += result.values[i] * field.values[i];
        square += field.values[i] * field.values[i];
      }
    }
    return product / square;
  };
  EXPECT_GT(kept(even), 0.85);
  EXPECT_GT(kept(leds), 0.5);
}

TEST(Denoise, TellsTheNoiseThatItLetsPass) {
  // Other noise of the same kind is in the field: what is left of it must have the size that is told.
  const core::CellField field = truth(kGrid);
  const Denoised result = denoise(sum(field, noise_field(kGrid, 0.1, 5)), noise_field(kGrid, 0.1, 6));
  EXPECT_GT(std::sqrt(result.noise_square()), 0.005);
  EXPECT_LT(std::sqrt(result.noise_square()), 0.05);
  EXPECT_LT(std::sqrt(result.noise_square()), 1.2 * rms_difference(result.field, field));
}

TEST(Denoise, KeepsSlopeEdgeLineAndSpotInNoise) {
  const core::CellField field = truth(kGrid);
  const core::CellField result = denoise(sum(field, noise_field(kGrid, 0.1, 3)), noise_field(kGrid, 0.1, 4)).field;
  EXPECT_LT(rms_difference(result, field), 0.05);  // half of the noise
  double line = 0.0;
  for (int ix = 0; ix < kGrid.nx; ++ix)
    line += (result.values[static_cast<std::size_t>(ix)] - 0.8 * ix / kGrid.nx) / kGrid.nx;
  EXPECT_NEAR(line, 0.3, 0.06);
  // An isolated spot fills little of the windows in which significance is judged, so only the larger part of it passes
  // at once.
  EXPECT_GT(result.at(20.5, 20.5) - 0.8 * 20 / kGrid.nx, 0.4);
  EXPECT_LT(result.at(20.5, 20.5), 1.1 * field.at(20.5, 20.5));
}

}  // namespace
}  // namespace evenglow::design
