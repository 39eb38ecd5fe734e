#include "design/dots/keep_out.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

/// 10 mm x 6 mm, 1 mm of margin on the left, a square and a round zone.
const FreeArea kFree({0.0, 10.0, 0.0, 6.0}, {1.0, 0.0, 0.0, 0.0}, {{4.0, 5.0, 2.0, 3.0}}, {{8.0, 3.0, 1.0}});

TEST(FreeArea, ClearanceIsTheDistanceToTheNearestBorder) {
  EXPECT_DOUBLE_EQ(kFree.clearance(1.5, 3.0, 9.0), 0.5);                   // margin
  EXPECT_DOUBLE_EQ(kFree.clearance(3.75, 2.5, 9.0), 0.25);                 // side of the square
  EXPECT_DOUBLE_EQ(kFree.clearance(3.7, 3.4, 9.0), std::hypot(0.3, 0.4));  // its corner
  EXPECT_DOUBLE_EQ(kFree.clearance(6.5, 3.0, 9.0), 0.5);                   // circle
  EXPECT_DOUBLE_EQ(kFree.clearance(6.0, 3.0, 0.1), 0.1);                   // no farther than asked
}

TEST(FreeArea, ClearanceIsNegativeWhereNoDotMayBe) {
  EXPECT_DOUBLE_EQ(kFree.clearance(0.5, 3.0, 9.0), -0.5);
  EXPECT_DOUBLE_EQ(kFree.clearance(4.5, 2.75, 9.0), -0.25);
  EXPECT_DOUBLE_EQ(kFree.clearance(8.0, 3.0, 9.0), -1.0);
  EXPECT_DOUBLE_EQ(kFree.clearance(11.0, 3.0, 9.0), -1.0);
}

TEST(FreeArea, BordersPointIntoTheFreeArea) {
  int borders = 0;
  kFree.borders_within(6.9, 3.0, 0.2, [&](const FreeArea::Border& border) {
    EXPECT_NEAR(border.distance, 0.1, 1e-12);
    EXPECT_NEAR(border.nx, -1.0, 1e-12);
    EXPECT_NEAR(border.ny, 0.0, 1e-12);
    ++borders;
  });
  EXPECT_EQ(borders, 1);
}

/// Exact for margins; 64 x 64 points see a border of a cell to 1/64 of its perimeter at the worst.
TEST(FreeArea, SharesOfCells) {
  const core::CellField share = kFree.free_share(core::CellGrid::over(5, 3, 0.0, 0.0, 10.0, 6.0));
  EXPECT_DOUBLE_EQ(share.values[0], 0.5);
  EXPECT_NEAR(share.values[1 * 5 + 2], 0.75, 1e-12);
  EXPECT_DOUBLE_EQ(share.values[1], 1.0);
  const double half_disk = 0.5 * 3.14159265358979 / 4.0;
  EXPECT_NEAR(share.values[1 * 5 + 3], 1.0 - half_disk, 0.01);
  EXPECT_NEAR(share.values[1 * 5 + 4], 1.0 - half_disk, 0.01);
}

}  // namespace
}  // namespace evenglow::tests
