#include "design/problem/density_limits.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

core::CellField random_field(int nx, int ny) {
  core::CellField field(core::CellGrid::over(nx, ny, 0, 0, nx, ny), 0.0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-3.0, -0.5);
  for (double& value : field.values) value = std::exp(uniform(random));
  return field;
}

double greatest_ratio(const core::CellField& field) {
  double result = 1.0;
  const int nx = field.grid.nx;
  const auto ratio = [&](int i, int j) {
    const double r = field.values[static_cast<std::size_t>(i)] / field.values[static_cast<std::size_t>(j)];
    return std::max(r, 1.0 / r);
  };
  for (int iy = 0; iy < field.grid.ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const int i = iy * nx + ix;
      if (ix + 1 < nx) result = std::max(result, ratio(i, i + 1));
      if (iy + 1 < field.grid.ny) result = std::max(result, ratio(i, i + nx));
    }
  }
  return result;
}

TEST(DensityLimits, NeighborRatioIsKeptEverywhere) {
  core::CellField field = random_field(30, 17);
  ASSERT_GT(greatest_ratio(field), 5.0);
  limit_neighbor_ratio(1.2, field);
  EXPECT_LE(greatest_ratio(field), 1.2 + 1e-9);
  EXPECT_GT(greatest_ratio(field), 1.19) << "no more is taken than must be";
}

TEST(DensityLimits, AFieldThatKeepsTheRatioStays) {
  core::CellField field(core::CellGrid::over(20, 5, 0, 0, 20, 5), 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = 0.1 * std::pow(1.1, i % 20);
  const core::CellField before = field;
  limit_neighbor_ratio(1.2, field);
  EXPECT_EQ(field.values, before.values);
}

TEST(DensityLimits, SymmetryAboutEachAxis) {
  for (const std::string symmetry : {"x", "y", "both"}) {
    core::CellField field = random_field(7, 4);
    DesignSpec spec;
    spec.symmetry = symmetry;
    make_symmetric(spec, field);
    const auto at = [&](int ix, int iy) { return field.values[static_cast<std::size_t>(iy * 7 + ix)]; };
    double x = 0.0, y = 0.0;
    for (int iy = 0; iy < 4; ++iy) {
      for (int ix = 0; ix < 7; ++ix) {
        x = std::max(x, std::abs(at(ix, iy) - at(6 - ix, iy)));
        y = std::max(y, std::abs(at(ix, iy) - at(ix, 3 - iy)));
      }
    }
    EXPECT_EQ(x < 1e-15, symmetry != "y") << symmetry;
    EXPECT_EQ(y < 1e-15, symmetry != "x") << symmetry;
  }
}

TEST(DensityLimits, MapsNarrowTheNumbers) {
  DesignSpec spec;
  spec.density_min = 0.05;
  spec.density_max = 0.6;
  spec.least_map = {2, 1, {0.0, 0.2}};
  spec.largest_map = {2, 1, {0.9, 0.1}};
  const core::CellGrid cells = core::CellGrid::over(2, 1, 0, 0, 2, 1);
  const CellLimits limits = cell_limits(spec, cells);
  EXPECT_EQ(limits.least.values, (std::vector<double>{0.05, 0.1})) << "where they cross the largest counts";
  EXPECT_EQ(limits.largest.values, (std::vector<double>{0.6, 0.1}));
  tracer::DensityField density{core::CellField(cells, 0.8)};
  EXPECT_EQ(within(limits, density).cells.values, (std::vector<double>{0.6, 0.1}));
}

/// Limits cell by cell take nothing of what the density keeps: ratio of neighbors and mirror images.
TEST(CellLimits, AreAsSmoothAndSymmetricAsTheDensityMustBe) {
  DesignSpec spec;
  spec.density_min = 0.01;
  spec.density_max = 0.8;
  spec.neighbor_ratio = 1.5;
  spec.symmetry = std::string(1, 'x');
  spec.largest_map.nx = 8;
  spec.largest_map.ny = 1;
  spec.largest_map.values = {0.8, 0.8, 0.05, 0.8, 0.8, 0.8, 0.8, 0.8};
  const core::CellGrid grid = core::CellGrid::over(8, 1, 0, 0, 8, 1);
  const CellLimits limits = cell_limits(spec, grid);
  EXPECT_DOUBLE_EQ(limits.largest.values[2], 0.05);
  EXPECT_DOUBLE_EQ(limits.largest.values[5], 0.05) << "its mirror image";
  tracer::DensityField density{core::CellField(grid, 0.4)};
  density = within(limits, std::move(density));
  for (std::size_t i = 0; i < 7; ++i) {
    const double ratio = density.cells.values[i + 1] / density.cells.values[i];
    EXPECT_LT(std::max(ratio, 1.0 / ratio), 1.5 + 1e-9) << i;
  }
}

TEST(ScaleToMean, BringsTheMeanWithinTheLimits) {
  DesignSpec spec;
  spec.density_min = 0.01;
  spec.density_max = 0.3;
  const core::CellGrid grid = core::CellGrid::over(4, 1, 0, 0, 4, 1);
  core::CellField shape(grid, 1.0);
  shape.values = {1.0, 2.0, 4.0, 8.0};
  const CellLimits limits = cell_limits(spec, grid);
  const auto mean_at = [&](double mean) {
    const double scale = scale_to_mean(shape, limits, mean);
    tracer::DensityField density{shape};
    for (double& value : density.cells.values) value *= scale;
    return within(limits, std::move(density)).cells.mean();
  };
  EXPECT_DOUBLE_EQ(scale_to_mean(shape, limits, 0.1), 0.1 / 3.75) << "no limit in the way";
  EXPECT_NEAR(mean_at(0.2), 0.2, 1e-12) << "the largest stands at 0.3";
  EXPECT_NEAR(mean_at(0.5), 0.3, 1e-12) << "as far as the limits go";
  EXPECT_NEAR(mean_at(0.001), 0.01, 1e-12);
}

TEST(HeldCells, AreThoseAtALimit) {
  DesignSpec spec;
  spec.density_min = 0.01;
  spec.density_max = 0.3;
  core::CellField density(core::CellGrid::over(4, 1, 0, 0, 4, 1), 0.1);
  density.values[0] = 0.01;
  density.values[3] = 0.3;
  density.values[2] = 0.3;
  const HeldCells held = held_cells(cell_limits(spec, density.grid), density);
  EXPECT_EQ(held.low, 1);
  EXPECT_EQ(held.high, 2);
}

}  // namespace
}  // namespace evenglow::design
