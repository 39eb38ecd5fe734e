#include "design/dots/neighbors.h"

#include <limits>

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "design/dots/process.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

NeighborStatistics statistics_of(const core::DotPattern& dots) {
  return neighbor_statistics(index_dots(dots, {0, 20, 0, 10}, 2), core::Footprint::round, 2);
}

TEST(DotStore, FindsAllDotsNearAPoint) {
  const core::DotPattern dots = random_dots(3000, 9);
  const DotStore store = index_dots(dots, {0, 20, 0, 10}, 2);
  ASSERT_EQ(store.size(), dots.size());
  for (const auto& [x, y, reach] : {std::array{3.0, 4.0, 0.5}, std::array{0.0, 0.0, 1.0}, std::array{19.9, 9.9, 3.0}}) {
    std::size_t expected = 0, found = 0;
    for (const core::Dot& dot : dots) expected += std::hypot(dot.x - x, dot.y - y) < reach;
    store.near(x, y, reach,
               [&](std::size_t i) { found += std::hypot(store.dots().x[i] - x, store.dots().y[i] - y) < reach; });
    EXPECT_EQ(found, expected);
  }
}

TEST(Neighbors, AgreeWithAllPairs) {
  const core::DotPattern dots = random_dots(800, 6);
  double least = 1e9, sum = 0.0;
  std::size_t overlaps = 0;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < dots.size(); ++j) {
      if (j != i) nearest = std::min(nearest, std::hypot(dots[i].x - dots[j].x, dots[i].y - dots[j].y));
    }
    least = std::min(least, nearest);
    sum += nearest;
    overlaps += nearest < 0.01;
  }
  const NeighborStatistics n = statistics_of(dots);
  EXPECT_NEAR(n.least_distance, least, 1e-12);
  EXPECT_NEAR(n.mean_distance, sum / 800.0, 1e-9);
  EXPECT_NEAR(n.least_gap, least - 0.01, 1e-9);
  EXPECT_EQ(n.overlaps, overlaps);
}

TEST(Neighbors, TellOrderFromChance) {
  EXPECT_NEAR(statistics_of(random_dots(20000, 3)).mean_relative, 0.5, 0.03);
  EXPECT_GT(statistics_of(lattice_pattern(0.1)).mean_relative, 0.85);
}

TEST(Process, GrowsAndScattersDots) {
  const core::DotPattern dots = lattice_pattern(0.1);
  const core::DotPattern grown = processed(dots, {0.004, 0.0, 0.0}, 1, 2);
  EXPECT_FLOAT_EQ(grown[5].radius, 0.032f);
  EXPECT_EQ(grown[5].x, dots[5].x);
  const core::DotPattern scattered = processed(dots, {0.0, 0.002, 0.001}, 1, 2);
  EXPECT_EQ(scattered, processed(dots, {0.0, 0.002, 0.001}, 1, 1));
  double size2 = 0.0, place2 = 0.0;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    size2 += std::pow(2.0 * static_cast<double>(scattered[i].radius - dots[i].radius), 2);
    place2 += std::pow(scattered[i].x - dots[i].x, 2);
  }
  // 20000 dots: the standard error of a standard deviation is 0.5 %; 4 of them.
  EXPECT_NEAR(std::sqrt(size2 / 20000.0), 0.002, 0.00004);
  EXPECT_NEAR(std::sqrt(place2 / 20000.0), 0.001, 0.00002);
  EXPECT_TRUE(processed(dots, {-0.06, 0.0, 0.0}, 1, 1).empty());
}

}  // namespace
}  // namespace evenglow::tests
