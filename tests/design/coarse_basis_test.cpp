#include "design/updaters/coarse_basis.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

const core::CellGrid kCells = core::CellGrid::over(12, 8, 5.0, 1.0, 29.0, 9.0);

TEST(CoarseBasis, TentsAddUpToOne) {
  const CoarseBasis basis(kCells, 4, 2);
  EXPECT_EQ(basis.count(), 8U);
  for (const double value : basis.field(std::vector<double>(8, 1.0)).values) EXPECT_NEAR(value, 1.0, 1e-6);
}

TEST(CoarseBasis, IsLinearBetweenItsNodes) {
  const CoarseBasis basis(kCells, 4, 1);  // nodes at x = 8, 14, 20, 26
  const core::CellField field = basis.field({8.0, 14.0, 20.0, 26.0});
  for (int ix = 0; ix < 12; ++ix) {
    const double x = std::clamp(kCells.center_x(ix), 8.0, 26.0);
    for (int iy = 0; iy < 8; ++iy) EXPECT_NEAR(field.values[static_cast<std::size_t>(iy * 12 + ix)], x, 1e-5);
  }
}

TEST(CoarseBasis, MeansOfAConstantAreThat) {
  const CoarseBasis basis(kCells, 5, 3);
  for (const double mean : basis.means(core::CellField(kCells, 0.7))) EXPECT_NEAR(mean, 0.7, 1e-12);
}

TEST(CoarseBasis, OneNodeHoldsAll) {
  const CoarseBasis basis(kCells, 1, 1);
  for (const double value : basis.field({2.0}).values) EXPECT_EQ(value, 2.0);
}

TEST(CoarseBasis, TellsTheNearestNode) {
  const CoarseBasis basis(kCells, 2, 2);
  const auto nearest = basis.nearest_node(core::CellGrid::over(4, 2, 5.0, 1.0, 29.0, 9.0));
  EXPECT_EQ(nearest, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3}));
}

}  // namespace
}  // namespace evenglow::design
