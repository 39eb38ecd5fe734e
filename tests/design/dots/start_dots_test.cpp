#include "design/dots/start_dots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

const CoverageMap kMap(graded_coverage(), whole_plate({}, {{10.0, 5.0, 2.0}}));

TEST(StartDots, AsManyAsTheAreaAsksFor) {
  const DotSpec spec;
  const SizeLaw law(spec, kMap);
  const core::CellField wanted = wanted_counts(kMap, law);
  const DotStore store = start_dots(spec, kMap, law, 2);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell)
    ASSERT_LE(std::abs(static_cast<double>(store.end(cell) - store.begin(cell)) - wanted.values[cell]), 1.0) << cell;
}

TEST(StartDots, EachInItsCellAndWholeInTheFreeArea) {
  const DotSpec spec;
  const DotStore store = start_dots(spec, kMap, SizeLaw(spec, kMap), 1);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) {
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
      const double x = store.dots().x[i], y = store.dots().y[i];
      ASSERT_EQ(static_cast<std::size_t>(store.grid().nearest_index(x, y)), cell);
      ASSERT_GE(kMap.free().clearance(x, y, 1.0), 0.03);
    }
  }
}

TEST(StartDots, SameBitsOnAnyNumberOfThreadsAndOthersForAnotherSeed) {
  DotSpec spec;
  const SizeLaw law(spec, kMap);
  const std::vector<double> one = start_dots(spec, kMap, law, 1).dots().x;
  EXPECT_EQ(start_dots(spec, kMap, law, 4).dots().x, one);
  spec.seed = 2;
  EXPECT_NE(start_dots(spec, kMap, law, 1).dots().x, one);
}

/// A cell of 1.25 mm of which a strip of 0.05 mm is free has no place for dots of 60 um.
TEST(StartDots, FewerWhereThereIsNoPlace) {
  const CoverageMap map(graded_coverage(), whole_plate({{0.05, 20.0, 0.0, 10.0}}));
  const DotSpec spec;
  EXPECT_EQ(start_dots(spec, map, SizeLaw(spec, map), 1).size(), 0u);
}

TEST(ForEachCell, WorksOnEachOnce) {
  std::vector<int> times(1001, 0);
  for_each_cell(times.size(), 4, [&](std::size_t cell) { ++times[cell]; });
  EXPECT_EQ(times, std::vector<int>(1001, 1));
}

}  // namespace
}  // namespace evenglow::tests
