#include "design/problem/regrid.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

core::CellField wave(int nx, int ny) {
  core::CellField field(core::CellGrid::over(nx, ny, 1, 2, 31, 22), 0.0);
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      field.values[static_cast<std::size_t>(iy * nx + ix)] =
          2.0 + std::sin(0.2 * field.grid.center_x(ix)) * std::cos(0.3 * field.grid.center_y(iy));
    }
  }
  return field;
}

TEST(Regrid, CoarserCellsTakeTheMeanOfWhatTheyCover) {
  const core::CellField fine = wave(60, 40);
  for (const auto& [nx, ny] : {std::pair{20, 10}, {7, 13}, {1, 1}}) {
    const core::CellField coarse = regrid(fine, core::CellGrid::over(nx, ny, 1, 2, 31, 22));
    EXPECT_NEAR(coarse.mean(), fine.mean(), 1e-12) << nx;
  }
  core::CellField spike(core::CellGrid::over(4, 1, 0, 0, 4, 1), 0.0);
  spike.values = {0, 8, 0, 0};
  EXPECT_EQ(regrid(spike, core::CellGrid::over(2, 1, 0, 0, 4, 1)).values, (std::vector<double>{4, 0}));
}

TEST(Regrid, FinerCellsInterpolate) {
  const core::CellField coarse = wave(60, 40);
  const core::CellField fine = regrid(coarse, core::CellGrid::over(180, 120, 1, 2, 31, 22));
  const core::CellField truth = wave(180, 120);
  for (int iy = 5; iy < 115; ++iy) {
    for (int ix = 5; ix < 175; ++ix) {
      const auto i = static_cast<std::size_t>(iy * 180 + ix);
      ASSERT_NEAR(fine.values[i], truth.values[i], 0.005);
    }
  }
}

TEST(Regrid, FinerInOneAxisAndCoarserInTheOther) {
  core::CellField field(core::CellGrid::over(2, 4, 0, 0, 2, 4), 0.0);
  field.values = {0, 4, 2, 6, 0, 4, 2, 6};
  const core::CellField result = regrid(field, core::CellGrid::over(4, 2, 0, 0, 2, 4));
  EXPECT_EQ(result.values, (std::vector<double>{1, 2, 4, 5, 1, 2, 4, 5}));
}

TEST(Regrid, BeyondTheFieldTheOutermostCellsHold) {
  core::CellField field(core::CellGrid::over(2, 1, 10, 0, 12, 1), 0.0);
  field.values = {3, 5};
  const core::CellField result = regrid(field, core::CellGrid::over(6, 1, 0, 0, 24, 1));
  EXPECT_EQ(result.values, (std::vector<double>{3, 3, 4, 5, 5, 5}));
}

TEST(Regrid, SameCellsKeepTheirBits) {
  const core::CellField field = wave(13, 7);
  EXPECT_EQ(regrid(field, field.grid).values, field.values);
}

}  // namespace
}  // namespace evenglow::design
