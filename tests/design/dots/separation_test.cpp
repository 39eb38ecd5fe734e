#include <cmath>

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "design/dots/neighbors.h"
#include "design/dots/relaxation.h"
#include "design/dots/start_dots.h"
#include "tests/design/dots/dot_samples.h"

/// Dots that are too near to each other (relaxation.h: separate, settle_conflicts).
namespace evenglow::tests {
namespace {

using namespace evenglow::design;

double least_gap(const DotStore& store) {
  return neighbor_statistics(store, core::Footprint::round, 1).least_gap;
}

TEST(Separation, ScatteredDotsComeApartWithinTheirCells) {
  const DotSpec spec;
  const CoverageMap map(graded_coverage(), whole_plate());
  const SizeLaw law(spec, map);
  DotStore store = start_dots(spec, map, law, 1);
  std::vector<std::size_t> counts;
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) counts.push_back(store.end(cell) - store.begin(cell));
  EXPECT_LT(least_gap(store), 0.0);
  EXPECT_TRUE(separate(spec, map, 5000, 2, store));
  EXPECT_GE(least_gap(store), spec.gap);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell)
    ASSERT_EQ(store.end(cell) - store.begin(cell), counts[cell]);
}

TEST(Separation, TellsWhenItHasNotSucceeded) {
  const DotSpec spec;
  const CoverageMap map(graded_coverage(), whole_plate());
  DotStore store = start_dots(spec, map, SizeLaw(spec, map), 1);
  EXPECT_FALSE(separate(spec, map, 1, 1, store));
}

/// A cell of 0.2 mm has no place for ten dots of 60 um with a gap of 10 um: some go, the others keep their distance.
TEST(Separation, ConflictsThatCannotBeSettledCostDots) {
  const DotSpec spec;
  const CoverageMap map(core::CellField(core::CellGrid::over(1, 1, 0.0, 0.0, 0.2, 0.2), 0.7),
                        {{0.0, 0.2, 0.0, 0.2}, {}, {}, {}});
  DotStore store = start_dots(spec, map, SizeLaw(spec, map), 1);
  const std::size_t before = store.size();
  const std::size_t removed = settle_conflicts(spec, map, store);
  EXPECT_GT(removed, 0u);
  EXPECT_EQ(store.size() + removed, before);
  EXPECT_GE(least_gap(store), spec.gap);
}

}  // namespace
}  // namespace evenglow::tests
