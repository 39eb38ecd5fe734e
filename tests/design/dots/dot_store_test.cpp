#include "design/dots/dot_store.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

constexpr RectangleZone kPlate{0.0, 20.0, 0.0, 10.0};

bool within(const DotStore& store, std::size_t i, double x, double y, double reach) {
  return std::abs(store.dots().x[i] - x) <= reach && std::abs(store.dots().y[i] - y) <= reach;
}

/// Every dot within the square is visited, and each once; places beyond the border are served as well.
TEST(DotStore, NearMissesNoDotAndVisitsNoneTwice) {
  const DotStore store = index_dots(random_dots(3000, 5), kPlate, 1);
  core::PhotonRng rng({6, 0, 0}, 0);
  for (int k = 0; k < 300; ++k) {
    const double x = 24.0 * rng.uniform() - 2.0, y = 14.0 * rng.uniform() - 2.0, reach = 1.5 * rng.uniform();
    std::multiset<std::size_t> visited;
    store.near(x, y, reach, [&](std::size_t i) { visited.insert(i); });
    for (std::size_t i = 0; i < store.size(); ++i) {
      ASSERT_LE(visited.count(i), 1u);
      const bool missed = within(store, i, x, y, reach) && visited.count(i) == 0;
      ASSERT_FALSE(missed) << x << " " << y << " " << reach;
    }
  }
}

TEST(DotStore, SortedDotsAreInTheirCells) {
  const DotStore store = index_dots(random_dots(2000, 7), kPlate, 2);
  std::size_t all = 0;
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) {
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i, ++all)
      ASSERT_EQ(static_cast<std::size_t>(store.grid().nearest_index(store.dots().x[i], store.dots().y[i])), cell);
  }
  EXPECT_EQ(all, 2000u);
}

TEST(DotStore, SameOrderOnAnyNumberOfThreads) {
  const core::DotPattern dots = random_dots(9000, 8);
  EXPECT_EQ(index_dots(dots, kPlate, 1).dots().x, index_dots(dots, kPlate, 4).dots().x);
}

TEST(DotStore, RemovedDotsAreGoneAndTheOthersFound) {
  DotStore store = index_dots(random_dots(1000, 9), kPlate, 1);
  std::vector<char> marked(store.size(), 0);
  std::vector<double> kept;
  for (std::size_t i = 0; i < store.size(); ++i) {
    marked[i] = i % 3 == 0;
    if (marked[i] == 0) kept.push_back(store.dots().x[i]);
  }
  store.remove(marked);
  std::vector<double> left = store.dots().x;  // each cell is sorted anew
  std::sort(left.begin(), left.end());
  std::sort(kept.begin(), kept.end());
  EXPECT_EQ(left, kept);
  std::size_t seen = 0;
  store.near(10.0, 5.0, 20.0, [&](std::size_t) { ++seen; });
  EXPECT_EQ(seen, kept.size());
}

}  // namespace
}  // namespace evenglow::tests
