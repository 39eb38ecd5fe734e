#include "design/dots/dot_index.h"

#include <gtest/gtest.h>

#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

TEST(DotIndex, BoundsHoldTheDotsWhole) {
  const core::DotPattern dots = {{1.0, 2.0, 0.5f, 0.0f}, {4.0, 1.0, 0.25f, 0.0f}, {3.0, 6.0, 1.0f, 0.0f}};
  const RectangleZone box = bounds_of(dots);
  EXPECT_DOUBLE_EQ(box.x0, 0.5);
  EXPECT_DOUBLE_EQ(box.x1, 4.25);
  EXPECT_DOUBLE_EQ(box.y0, 0.75);
  EXPECT_DOUBLE_EQ(box.y1, 7.0);
}

TEST(DotIndex, HoldsEveryDotWithItsDiameter) {
  const core::DotPattern dots = random_dots(5000, 3, 0.02f);
  const DotStore store = index_dots(dots, {0.0, 20.0, 0.0, 10.0}, 2);
  ASSERT_EQ(store.size(), dots.size());
  double sum = 0.0, kept = 0.0;
  for (const core::Dot& dot : dots) sum += dot.x + 7.0 * dot.y;
  for (std::size_t i = 0; i < store.size(); ++i) {
    kept += store.dots().x[i] + 7.0 * store.dots().y[i];
    ASSERT_EQ(store.dots().diameter[i], 0.04f);
  }
  EXPECT_NEAR(kept, sum, 1e-6);
  EXPECT_NEAR(static_cast<double>(store.size()) / static_cast<double>(store.cell_count()), 50.0, 15.0);
}

}  // namespace
}  // namespace evenglow::tests
