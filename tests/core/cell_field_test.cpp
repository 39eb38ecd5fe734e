#include "core/math/cell_field.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

CellField ramp(int nx, int ny) {
  CellField field(CellGrid::over(nx, ny, 1.0, 2.0, 1.0 + 2.0 * nx, 2.0 + 3.0 * ny), 0.0);
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      field.values[static_cast<std::size_t>(iy * nx + ix)] =
          5.0 + 0.5 * field.grid.center_x(ix) - 0.25 * field.grid.center_y(iy);
    }
  }
  return field;
}

TEST(CellGrid, GeometryAndIndex) {
  const CellGrid grid = CellGrid::over(4, 3, 1.0, 2.0, 9.0, 11.0);
  EXPECT_EQ(grid.size(), 12U);
  EXPECT_DOUBLE_EQ(grid.cell_area(), 6.0);
  EXPECT_DOUBLE_EQ(grid.center_x(0), 2.0);
  EXPECT_DOUBLE_EQ(grid.center_y(2), 9.5);
  EXPECT_EQ(grid.index_at(1.0, 2.0), 0);
  EXPECT_EQ(grid.index_at(8.9, 10.9), 11);
  EXPECT_EQ(grid.index_at(3.1, 5.1), 5);  // rows are y
  EXPECT_EQ(grid.index_at(9.0, 5.0), -1);
  EXPECT_EQ(grid.index_at(0.99, 5.0), -1);
  EXPECT_EQ(grid.index_at(5.0, 11.0), -1);
  EXPECT_EQ(grid.index_at(std::nan(""), 5.0), -1);
  EXPECT_EQ(grid.nearest_index(100.0, -100.0), 3);
  EXPECT_EQ(grid.nearest_index(-100.0, 100.0), 8);
}

TEST(CellField, MeanMinMaxAt) {
  const CellField field = ramp(4, 3);
  EXPECT_NEAR(field.mean(), 5.0 + 0.5 * 5.0 - 0.25 * 6.5, 1e-12);
  EXPECT_DOUBLE_EQ(field.min(), field.at(-100.0, 100.0));
  EXPECT_DOUBLE_EQ(field.max(), field.at(100.0, -100.0));
}

TEST(CellField, BilinearKeepsARampInside) {
  const CellField field = ramp(8, 6);
  const CellGrid fine = CellGrid::over(21, 17, 2.5, 4.0, 15.5, 18.0);
  const CellField result = resample_bilinear(field, fine);
  for (int iy = 0; iy < fine.ny; ++iy) {
    for (int ix = 0; ix < fine.nx; ++ix) {
      EXPECT_NEAR(result.values[static_cast<std::size_t>(iy * fine.nx + ix)],
                  5.0 + 0.5 * fine.center_x(ix) - 0.25 * fine.center_y(iy), 1e-12);
    }
  }
}

TEST(CellField, ResamplingIsConstantBeyondTheCenters) {
  const CellField one(CellGrid::over(1, 1, 0, 0, 1, 1), 7.0);
  const CellGrid wide = CellGrid::over(3, 2, -5, -5, 5, 5);
  for (const double v : resample_bilinear(one, wide).values) EXPECT_DOUBLE_EQ(v, 7.0);
  for (const double v : resample_nearest(one, wide).values) EXPECT_DOUBLE_EQ(v, 7.0);
  const CellField field = ramp(4, 3);
  EXPECT_EQ(resample_nearest(field, field.grid).values, field.values);
  EXPECT_DOUBLE_EQ(resample_bilinear(field, CellGrid::over(1, 1, -9, -9, -7, -7)).values[0], field.values[0]);
}

TEST(CellField, SmoothingKeepsSumAndConstants) {
  CellField field(CellGrid::over(12, 9, 0, 0, 12, 9), 0.0);
  field.values[0] = 4.0;
  field.values[50] = -1.0;
  for (const double sigma : {0.3, 1.0, 2.5, 7.0}) {
    const CellField smooth = smooth_gaussian(field, sigma);
    EXPECT_NEAR(std::accumulate(smooth.values.begin(), smooth.values.end(), 0.0), 3.0, 1e-12) << sigma;
  }
  EXPECT_EQ(smooth_gaussian(field, 0.0).values, field.values);
  for (const double v : smooth_gaussian(CellField(field.grid, 2.5), 1.7).values) EXPECT_NEAR(v, 2.5, 1e-12);
}

/// A point spreads with the variance that was asked for, the same in x and in y.
TEST(CellField, SmoothingHasItsWidth) {
  CellField field(CellGrid::over(41, 41, 0, 0, 41, 41), 0.0);
  field.values[20 * 41 + 20] = 1.0;
  const CellField smooth = smooth_gaussian(field, 2.0);
  double x2 = 0.0, y2 = 0.0;
  for (int iy = 0; iy < 41; ++iy) {
    for (int ix = 0; ix < 41; ++ix) {
      const double v = smooth.values[static_cast<std::size_t>(iy * 41 + ix)];
      x2 += v * (ix - 20) * (ix - 20);
      y2 += v * (iy - 20) * (iy - 20);
    }
  }
  EXPECT_NEAR(x2, 4.0, 0.02);
  EXPECT_NEAR(y2, x2, 1e-12);
  const CellField along = smooth_gaussian(field, 2.0, 0.0);
  double across = 0.0;
  for (int iy = 0; iy < 41; ++iy) across += iy == 20 ? 0.0 : along.values[static_cast<std::size_t>(iy * 41 + 20)];
  EXPECT_EQ(across, 0.0);
  EXPECT_GT(along.values[20 * 41 + 22], 0.1);
}

}  // namespace
}  // namespace evenglow::core
