#include "tracer/transport/planar_cells.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace tracer;

DensityField field() {
  DensityField density{core::CellField(core::CellGrid::over(4, 2, 0.0, 0.0, 8.0, 6.0), 0.0)};
  for (std::size_t i = 0; i < density.cells.values.size(); ++i) density.cells.values[i] = static_cast<double>(i) / 7.0;
  return density;
}

TEST(PlanarCells, SameCellAsTheField) {
  const DensityField density = field();
  const PlanarCells cells(density);
  for (double x = -0.95; x < 9.0; x += 0.1) {
    for (double y = -0.95; y < 7.0; y += 0.1) {
      EXPECT_EQ(cells.cell(cells.column(x), cells.row(y)),
                static_cast<std::size_t>(density.cells.grid.nearest_index(x, y)));
    }
  }
}

TEST(PlanarCells, DepthIsThatOfTheOdds) {
  const PlanarCells cells(field());
  EXPECT_EQ(cells.depth(0), 0.0);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(cells.open(i), 1.0 - static_cast<double>(i) / 7.0, 1e-15);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_NEAR(1.0 - std::exp(-cells.depth(i)), static_cast<double>(i) / 7.0, 1e-15);
  EXPECT_EQ(cells.depth(7), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace evenglow::tests
