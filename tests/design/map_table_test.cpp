#include "design/problem/map_table.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

TEST(MapTable, StretchesOverAnyCells) {
  const MapTable map{{2, 1, {1.0, 3.0}}};
  const core::CellField fine = map.over(core::CellGrid::over(4, 2, 10, 20, 50, 30));
  EXPECT_EQ(fine.values, (std::vector<double>{1, 1.5, 2.5, 3, 1, 1.5, 2.5, 3}));
  EXPECT_EQ(map.over(core::CellGrid::over(1, 1, 0, 0, 1, 1)).values, (std::vector<double>{2.0}));
}

}  // namespace
}  // namespace evenglow::design
