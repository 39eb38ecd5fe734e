#include "tracer/scene/refined_density.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using tracer::DensityField;
using tracer::refined;

const core::CellGrid kGrid = core::CellGrid::over(6, 4, 0, 0, 12, 4);

double mean_of_cell(const core::CellField& fine, int n, int ix, int iy) {
  double sum = 0.0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) sum += fine.values[static_cast<std::size_t>((iy * n + j) * fine.grid.nx + ix * n + i)];
  }
  return sum / (n * n);
}

/// Something uneven between 0.05 and 0.45.
DensityField waves() {
  DensityField density{core::CellField(kGrid, 0.0)};
  for (std::size_t i = 0; i < density.cells.values.size(); ++i)
    density.cells.values[i] = 0.25 + 0.2 * std::sin(1.7 * static_cast<double>(i));
  return density;
}

TEST(RefinedDensity, IsLinearBetweenCentersWhereTheFieldIs) {
  DensityField density{core::CellField(kGrid, 0.0)};
  for (int iy = 0; iy < 4; ++iy) {
    for (int ix = 0; ix < 6; ++ix)
      density.cells.values[static_cast<std::size_t>(iy * 6 + ix)] =
          0.1 + 0.02 * kGrid.center_x(ix) + 0.01 * kGrid.center_y(iy);
  }
  const core::CellField fine = refined(density, 4).cells;
  EXPECT_EQ(fine.grid.nx, 24);
  EXPECT_DOUBLE_EQ(fine.grid.dx, 0.5);
  for (int iy = 4; iy < 12; ++iy) {
    for (int ix = 4; ix < 20; ++ix)  // the outermost cells have no neighbor on one side
      EXPECT_NEAR(fine.values[static_cast<std::size_t>(iy * 24 + ix)],
                  0.1 + 0.02 * fine.grid.center_x(ix) + 0.01 * fine.grid.center_y(iy), 1e-12);
  }
}

TEST(RefinedDensity, KeepsTheMeanOfEachCellAndTheRangeOfTheField) {
  const DensityField density = waves();
  for (const int n : {2, 3, 8}) {
    const core::CellField fine = refined(density, n).cells;
    for (int iy = 0; iy < 4; ++iy) {
      for (int ix = 0; ix < 6; ++ix)
        EXPECT_NEAR(mean_of_cell(fine, n, ix, iy), density.cells.values[static_cast<std::size_t>(iy * 6 + ix)], 1e-12);
    }
    EXPECT_GE(fine.min(), density.cells.min());
    EXPECT_LE(fine.max(), density.cells.max());
    const std::set<double> values(fine.values.begin(), fine.values.end());
    EXPECT_GT(values.size(), 2 * density.cells.values.size()) << "it runs within cells";
  }
}

TEST(RefinedDensity, OnePartIsTheFieldItself) {
  EXPECT_EQ(refined(waves(), 1).cells.values, waves().cells.values);
  EXPECT_THROW(refined(waves(), 0), core::Error);
  EXPECT_EQ(refined({core::CellField(kGrid, 0.3)}, 4).cells.values, std::vector<double>(24 * 16, 0.3));
}

std::string plate(const std::string& more) {
  return "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [8, 4], density: 0.2" + more +
         "}, sources: [{kind: led_row, count: 2}]";
}

TEST(RefinedDensity, IsAskedForByTheRunFile) {
  EXPECT_EQ(backlight_of(plate("")).microstructure->subcells, 1);
  EXPECT_EQ(backlight_of(plate(", interpolation: constant")).microstructure->subcells, 1);
  EXPECT_EQ(backlight_of(plate(", interpolation: bilinear")).microstructure->subcells, 4);
  const auto spec = backlight_of(plate(", interpolation: bilinear, subcells: 6"));
  EXPECT_EQ(spec.microstructure->subcells, 6);
  EXPECT_EQ(traced_density(spec, initial_density(spec)).cells.grid.nx, 48);
  const auto expect_fault = [](const std::string& more, const std::string& part) {
    std::string message;
    try {
      backlight_of(plate(more));
    } catch (const core::ConfigError& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect_fault(", interpolation: cubic", "microstructure.interpolation");
  expect_fault(", subcells: 3", "subcells: belongs to interpolation bilinear, got it with constant");
  expect_fault(", interpolation: bilinear, subcells: 1", "microstructure.subcells: must lie in [2, 16], got 1");
}

}  // namespace
}  // namespace evenglow::tests
