#include "design/dots/cell_errors.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

/// Two cells of 1 mm2 that are to hold 0.08 and 0.02 mm2; square dots of 0.1 mm: 0.01 mm2 each.
const core::CellGrid kCells = core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0);

core::CellField wanted() {
  core::CellField field(kCells, 0.08);
  field.values[1] = 0.02;
  return field;
}

core::DotPattern dots(int left, int right) {
  core::DotPattern pattern;
  for (int i = 0; i < left; ++i) pattern.push_back({0.1 * i + 0.05, 0.5, 0.05f, 0.0f});
  for (int i = 0; i < right; ++i) pattern.push_back({0.1 * i + 1.05, 0.5, 0.05f, 0.0f});
  return pattern;
}

TEST(CellErrors, AreCountedInDots) {
  const CoverageMap map(wanted(), {{0.0, 2.0, 0.0, 1.0}, {}, {}, {}});
  const CellErrors errors = cell_errors(dots(7, 4), core::Footprint::square, map);
  EXPECT_NEAR(errors.worst_dots, 2.0, 1e-5);
  EXPECT_NEAR(errors.rms_dots, std::sqrt((1.0 + 4.0) / 2.0), 1e-5);
  EXPECT_NEAR(errors.rms_relative, std::sqrt((0.125 * 0.125 + 1.0) / 2.0), 1e-5);
  EXPECT_NEAR(errors.mean_relative, 0.1, 1e-6);
  EXPECT_EQ(errors.beyond_one, 1u);
  EXPECT_NEAR(errors.held.values[0], 0.07, 1e-7);
}

TEST(CellErrors, CellsWithoutFreeAreaAreNotJudged) {
  const CoverageMap map(wanted(), {{0.0, 2.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}, {}, {}});  // the left cell is margin
  const CellErrors errors = cell_errors(dots(0, 2), core::Footprint::square, map);
  EXPECT_NEAR(errors.worst_dots, 0.0, 1e-5);
  EXPECT_EQ(errors.beyond_one, 0u);
}

TEST(CellErrors, NoDotsLackTheWholeArea) {
  const CoverageMap map(wanted(), {{0.0, 2.0, 0.0, 1.0}, {}, {}, {}});
  EXPECT_DOUBLE_EQ(cell_errors({}, core::Footprint::round, map).mean_relative, -1.0);
}

}  // namespace
}  // namespace evenglow::tests
