#include "tracer/microstructure/dot_grid.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tests {
namespace {

using core::Dot;
using core::DotPattern;
using core::Footprint;
using tracer::DotGrid;
using tracer::FaceArea;

constexpr FaceArea kFace = {-3.0, 17.0, 2.0, 12.0};

/// Dots anywhere, some of them over the border, of very different sizes: many overlap.
DotPattern random_dots(std::size_t count, double radius, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  DotPattern dots;
  for (std::size_t i = 0; i < count; ++i) {
    dots.push_back({kFace.x0 + 20.0 * u(random), kFace.y0 + 10.0 * u(random),
                    static_cast<float>(radius * (0.2 + u(random))), static_cast<float>(6.3 * u(random) - 3.0)});
  }
  return dots;
}

/// How far inside the outline of a dot; < 0: outside.
double depth_in(const Dot& dot, Footprint footprint, double x, double y) {
  const double dx = x - dot.x, dy = y - dot.y;
  const double r = static_cast<double>(dot.radius), a = static_cast<double>(dot.angle);
  if (footprint == Footprint::round) return r - std::hypot(dx, dy);
  const double u = std::cos(a) * dx + std::sin(a) * dy, v = std::cos(a) * dy - std::sin(a) * dx;
  return r - std::max(std::abs(u), std::abs(v));
}

/// Places are kept as floats.
constexpr double kRounding = 1e-5;

void compare_with_brute_force(const DotPattern& dots, Footprint footprint, unsigned seed) {
  const DotGrid grid(dots, footprint, kFace);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int covered = 0;
  for (int i = 0; i < 20000; ++i) {
    double x = kFace.x0 + 20.0 * u(random), y = kFace.y0 + 10.0 * u(random);
    if (i % 10 == 0) x = i % 20 == 0 ? kFace.x0 : kFace.x1;  // on the border
    if (i % 10 == 1) y = i % 20 == 1 ? kFace.y0 : kFace.y1;
    double deepest = -1.0;
    for (const Dot& dot : dots) deepest = std::max(deepest, depth_in(dot, footprint, x, y));
    if (std::abs(deepest) < kRounding) continue;
    const int found = grid.at(x, y);
    ASSERT_EQ(found >= 0, deepest > 0.0) << x << ' ' << y;
    ASSERT_EQ(grid.find(x, y) != nullptr, deepest > 0.0);
    if (found < 0) continue;
    ++covered;
    EXPECT_GT(depth_in(dots[static_cast<std::size_t>(found)], footprint, x, y), -kRounding);
  }
  EXPECT_GT(covered, 100);
  EXPECT_LT(covered, 19000);
}

TEST(DotGrid, FindsWhatASearchThroughAllDotsFinds) {
  for (const Footprint footprint : {Footprint::round, Footprint::square}) {
    compare_with_brute_force(random_dots(2000, 0.07, 1), footprint, 2);
    compare_with_brute_force(random_dots(50, 1.0, 3), footprint, 4);  // few that cover much
    compare_with_brute_force(random_dots(1, 2.5, 5), footprint, 6);
  }
}

TEST(DotGrid, SquaresAreTurned) {
  const float quarter = static_cast<float>(0.25 * core::kPi);
  const DotGrid straight({{5.0, 5.0, 1.0F, 0.0F}}, Footprint::square, kFace);
  const DotGrid turned({{5.0, 5.0, 1.0F, quarter}}, Footprint::square, kFace);
  EXPECT_TRUE(straight.covers(5.9, 5.9));
  EXPECT_FALSE(turned.covers(5.9, 5.9));
  EXPECT_FALSE(straight.covers(6.3, 5.0));
  EXPECT_TRUE(turned.covers(6.3, 5.0));
}

/// All bins of a ray, in their order, hold each dot that it crosses.
TEST(DotGrid, AWayPassesByAllDotsThatItCrosses) {
  const DotPattern dots = random_dots(3000, 0.05, 7);
  const DotGrid grid(dots, Footprint::round, kFace);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int ray = 0; ray < 300; ++ray) {
    const double x = kFace.x0 - 5.0 + 30.0 * u(random), y = kFace.y0 - 5.0 + 20.0 * u(random);
    const double turn = ray % 20 == 0 ? 0.5 * core::kPi * (ray / 20) : 6.3 * u(random), length = 25.0 * u(random);
    const double kx = ray % 40 == 0 ? 1.0 : std::cos(turn), ky = ray % 40 == 0 ? 0.0 : std::sin(turn);
    std::vector<bool> seen(dots.size(), false);
    double last = 0.0;
    grid.along(x, y, kx, ky, length, [&](auto entries, double way) {
      EXPECT_GE(way, last - 1e-9);
      last = way;
      for (const DotGrid::Entry& entry : entries) seen[entry.dot] = true;
      return false;
    });
    for (std::size_t i = 0; i < dots.size(); ++i) {
      const double t = std::clamp((dots[i].x - x) * kx + (dots[i].y - y) * ky, 0.0, length);
      const double px = x + t * kx, py = y + t * ky;
      if (px < kFace.x0 || px > kFace.x1 || py < kFace.y0 || py > kFace.y1) continue;
      const double distance = std::hypot(px - dots[i].x, py - dots[i].y);
      if (distance < static_cast<double>(dots[i].radius) - kRounding) {
        EXPECT_TRUE(seen[i]) << ray;
      }
    }
  }
}

TEST(DotGrid, CoverageIsTheAreaInEachCell) {
  // A dot in the middle of a cell, one on the border of two, one over the corner of the face.
  const DotGrid grid({{0.0, 4.0, 0.5F}, {2.0, 9.0, 0.5F}, {-3.0, 12.0, 0.5F}}, Footprint::round, kFace);
  const core::CellField share = grid.coverage(core::CellGrid::over(4, 2, kFace.x0, kFace.y0, kFace.x1, kFace.y1));
  const double one = 0.25 * core::kPi / 25.0;
  EXPECT_NEAR(share.values[0], one, 1e-9);
  EXPECT_NEAR(share.values[4], one * (0.5 + 0.25), 0.01 * one);
  EXPECT_NEAR(share.values[5], one * 0.5, 0.01 * one);
  EXPECT_EQ(share.values[7], 0.0);
}

TEST(DotGrid, CoverageCountsOverlapsOnce) {
  const DotPattern dots = random_dots(3000, 0.12, 9);
  const DotGrid grid(dots, Footprint::round, kFace);
  ASSERT_GE(grid.overlapping().first, 0);
  const core::CellGrid cells = core::CellGrid::over(8, 4, kFace.x0, kFace.y0, kFace.x1, kFace.y1);
  const core::CellField share = grid.coverage(cells);
  constexpr int kAlong = 300;
  for (int cell = 0; cell < 32; ++cell) {
    int covered = 0;
    for (int i = 0; i < kAlong * kAlong; ++i) {
      covered += grid.covers(cells.x0 + (cell % 8 + (i % kAlong + 0.5) / kAlong) * cells.dx,
                             cells.y0 + (cell / 8 + (i / kAlong + 0.5) / kAlong) * cells.dy)
                     ? 1
                     : 0;
    }
    EXPECT_NEAR(share.values[static_cast<std::size_t>(cell)], static_cast<double>(covered) / (kAlong * kAlong), 0.003);
  }
}

TEST(DotGrid, TellsOverlaps) {
  const auto overlap = [](DotPattern dots, Footprint footprint) {
    return DotGrid(dots, footprint, kFace).overlapping();
  };
  using Pair = std::pair<int, int>;
  EXPECT_EQ(overlap({{5, 5, 1.0F}, {8, 5, 1.0F}, {6.9, 5, 1.0F}}, Footprint::round), Pair(0, 2));
  EXPECT_EQ(overlap({{5, 5, 1.0F}, {7.01, 5, 1.0F}}, Footprint::round), Pair(-1, -1));
  EXPECT_EQ(overlap({{5, 5, 1.0F}, {6.9, 6.9, 1.0F}}, Footprint::square), Pair(0, 1));
  EXPECT_EQ(overlap({{5, 5, 1.0F}, {6.9, 6.9, 1.0F}}, Footprint::round), Pair(-1, -1));
  const float quarter = static_cast<float>(0.25 * core::kPi);
  EXPECT_EQ(overlap({{5, 5, 1.0F, quarter}, {6.9, 6.9, 1.0F, quarter}}, Footprint::square), Pair(-1, -1));
}

/// 150 bytes a dot are allowed, and huge dots must not fill the memory.
TEST(DotGrid, MemoryStaysSmall) {
  DotPattern lattice;
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 150; ++j)
      lattice.push_back({kFace.x0 + (i + 0.5) * 20.0 / 300.0, kFace.y0 + (j + 0.5) * 10.0 / 150.0, 0.025F});
  }
  for (const Footprint footprint : {Footprint::round, Footprint::square})
    EXPECT_LT(DotGrid(lattice, footprint, kFace).bytes(), 150 * lattice.size());
  for (Dot& dot : lattice) dot.radius = 0.5F;
  EXPECT_LT(DotGrid(lattice, Footprint::round, kFace).bytes(), 150 * lattice.size());
}

}  // namespace
}  // namespace evenglow::tests
