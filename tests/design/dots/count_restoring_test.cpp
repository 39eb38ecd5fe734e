#include "design/dots/count_restoring.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "design/dots/start_dots.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

/// Every dot of a start pushed 0.7 mm (half a cell) aside, at the right border back to it.
DotStore wandered(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law) {
  DotStore store = start_dots(spec, map, law, 1);
  for (double& x : store.dots().x) x = std::min(x + 0.7, 19.95);
  store.sort_all(1);
  return store;
}

TEST(RestoreCounts, EveryCellIsWithinOneDotAgain) {
  const DotSpec spec;
  const CoverageMap map(graded_coverage(), whole_plate());
  const SizeLaw law(spec, map);
  const core::CellField wanted = wanted_counts(map, law);
  DotStore store = wandered(spec, map, law);
  const std::size_t before = store.size();
  restore_counts(spec, map, wanted, 2, store);
  EXPECT_EQ(store.size(), before);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell)
    ASSERT_LT(std::abs(static_cast<double>(store.end(cell) - store.begin(cell)) - wanted.values[cell]), 1.0) << cell;
  for (std::size_t i = 0; i < store.size(); ++i)
    ASSERT_GE(map.free().clearance(store.dots().x[i], store.dots().y[i], 1.0), 0.03 - 1e-6);
}

TEST(RestoreCounts, LeavesGoodCountsAlone) {
  const DotSpec spec;
  const CoverageMap map(graded_coverage(), whole_plate());
  const SizeLaw law(spec, map);
  DotStore store = start_dots(spec, map, law, 1);
  const std::vector<double> before = store.dots().x;
  restore_counts(spec, map, wanted_counts(map, law), 1, store);
  EXPECT_EQ(store.dots().x, before);
}

/// A zone parts the plate: what is missing on the right cannot come from the left.
TEST(RestoreCounts, CellsThatNoWayReachesKeepWhatTheyHave) {
  const DotSpec spec;
  core::CellField coverage(core::CellGrid::over(3, 1, 0.0, 0.0, 3.0, 1.0), 0.1);
  const CoverageMap map(coverage, {{0.0, 3.0, 0.0, 1.0}, {}, {{1.0, 2.0, 0.0, 1.0}}, {}});
  const SizeLaw law(spec, map);
  DotStore store = start_dots(spec, map, law, 1);
  std::vector<char> right(store.size(), 0);
  for (std::size_t i = store.begin(2); i < store.end(2); ++i) right[i] = 1;
  store.remove(right);
  const std::size_t left = store.size();
  restore_counts(spec, map, wanted_counts(map, law), 1, store);
  EXPECT_EQ(store.end(0) - store.begin(0), left);
  EXPECT_EQ(store.end(2) - store.begin(2), 0u);
}

}  // namespace
}  // namespace evenglow::tests
