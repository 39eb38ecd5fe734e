#include "design/dots/coverage_map.h"

#include <numbers>

#include <gtest/gtest.h>

#include "design/dots/dot_counts.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

TEST(CoverageMap, HasNoStepsAndKeepsTheMeansOfCells) {
  const CoverageMap map(graded_coverage(), whole_plate());
  const core::CellGrid& g = map.grid();
  for (int ix = 0; ix < g.nx; ++ix) {
    double mean = 0.0;
    for (int k = 0; k < 50; ++k) mean += map.at((ix + (k + 0.5) / 50.0) * g.dx, 5.0) / 50.0;
    EXPECT_NEAR(mean / map.coverage().values[static_cast<std::size_t>(ix)], 1.0, ix == 0 || ix == 15 ? 0.05 : 0.01);
    EXPECT_NEAR(map.at(ix * g.dx - 1e-9, 5.0), map.at(ix * g.dx + 1e-9, 5.0), 1e-6);
  }
}

TEST(CoverageMap, CountsFreeAreaOnly) {
  const CoverageMap map(graded_coverage(), whole_plate({}, {{10.0, 5.0, 2.0}}, {1.25, 0.0, 0.0, 0.0}));
  double free = 0.0;
  for (std::size_t i = 0; i < map.grid().size(); ++i) free += map.free_share(i) * map.grid().cell_area();
  EXPECT_NEAR(free, 200.0 - 1.25 * 10.0 - 4.0 * std::numbers::pi, 0.02);
  EXPECT_EQ(map.wanted(0), 0.0);
}

TEST(FreeArea, KnowsDistancesToAllBorders) {
  const FreeArea free = whole_plate({{4.0, 6.0, 4.0, 6.0}}, {{15.0, 5.0, 1.0}});
  EXPECT_DOUBLE_EQ(free.clearance(0.5, 5.0, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(free.clearance(3.0, 5.0, 2.0), 1.0);
  EXPECT_NEAR(free.clearance(3.0, 3.0, 2.0), std::sqrt(2.0), 1e-12);
  EXPECT_DOUBLE_EQ(free.clearance(15.0, 6.5, 2.0), 0.5);
  EXPECT_LT(free.clearance(5.0, 5.0, 2.0), 0.0);
  EXPECT_LT(free.clearance(-0.1, 5.0, 2.0), 0.0);
  EXPECT_EQ(free.clearance(10.0, 5.0, 2.0), 2.0);
}

TEST(DotCounts, RoundsUpOrDownAndKeepsSums) {
  core::CellField wanted(core::CellGrid::over(40, 30, 0, 0, 40, 30), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < wanted.values.size(); ++i) sum += wanted.values[i] = 3.0 + 0.001 * static_cast<double>(i);
  double counted = 0.0;
  const std::vector<int> counts = whole_counts(wanted);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counted += counts[i];
    EXPECT_LT(std::abs(counts[i] - wanted.values[i]), 1.0);
  }
  EXPECT_NEAR(counted, sum, 10.0);
}

}  // namespace
}  // namespace evenglow::tests
