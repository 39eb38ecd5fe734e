#include "design/dots/scaled_sizes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "design/dots/neighbors.h"
#include "design/dots/placement.h"

namespace evenglow::design {
namespace {

struct Pattern {
  DotSpec spec;
  RectangleZone face{0.0, 6.0, 0.0, 4.0};
  FreeArea free{face, {}, {}, {}};
  core::CellGrid cells = core::CellGrid::over(6, 4, 0.0, 0.0, 6.0, 4.0);
  core::DotPattern dots;

  explicit Pattern(double coverage) {
    spec.mode = DotMode::both;
    spec.diameter_min = 0.03;
    spec.diameter_max = 0.08;
    dots = place_dots(spec, CoverageMap(core::CellField(cells, coverage), free), 1).dots;
  }
  core::DotPattern scaled(const std::function<double(double, double)>& factor, int threads = 1) const {
    return scaled_sizes(spec, free, cells, dots, factor, threads);
  }
};

double area(const core::DotPattern& dots, double x0, double x1) {
  double sum = 0.0;
  for (const core::Dot& dot : dots)
    if (dot.x >= x0 && dot.x < x1) sum += core::footprint_area(core::Footprint::round, 2.0 * dot.radius);
  return sum;
}

TEST(ScaledSizes, AreasFollowTheFactorOnTheSamePlaces) {
  const Pattern p(0.1);
  const auto factor = [](double x, double) { return x < 2.0 ? 1.03 : x < 4.0 ? 0.98 : 1.0; };
  const core::DotPattern dots = p.scaled(factor);
  ASSERT_EQ(dots.size(), p.dots.size());
  for (double x : {0.0, 2.0, 4.0})
    EXPECT_NEAR(area(dots, x, x + 2.0) / area(p.dots, x, x + 2.0), factor(x, 0.0), 0.0015) << x;
  for (const core::Dot& dot : dots) {
    const double steps = 2.0 * static_cast<double>(dot.radius) / p.spec.size_step;
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
    EXPECT_LE(2.0 * static_cast<double>(dot.radius), p.spec.diameter_max + 1e-6);
    EXPECT_GE(2.0 * static_cast<double>(dot.radius), p.spec.diameter_min - 1e-6);
  }
  const auto places = [](const core::DotPattern& pattern) {
    double x = 0.0, y = 0.0;
    for (const core::Dot& dot : pattern) {
      x += dot.x * dot.y;
      y += dot.y * dot.y;
    }
    return std::pair{x, y};
  };
  EXPECT_NEAR(places(dots).first, places(p.dots).first, 1e-6);
  EXPECT_NEAR(places(dots).second, places(p.dots).second, 1e-6);
  EXPECT_EQ(dots, p.scaled(factor, 3));
}

/// Asked for far more than there is room for, the dots keep the gap and stay on the plate.
TEST(ScaledSizes, GapAndFreeAreaAreKept) {
  const Pattern p(0.35);
  const core::DotPattern dots = p.scaled([](double, double) { return 3.0; });
  EXPECT_GT(area(dots, 0.0, 6.0), area(p.dots, 0.0, 6.0));
  const auto statistics = neighbor_statistics(index_dots(dots, p.face, 1), p.spec.footprint, 1);
  EXPECT_GE(statistics.least_gap, p.spec.gap - 2e-6);
  for (const core::Dot& dot : dots) {
    const double r = static_cast<double>(dot.radius) - 1e-6;
    EXPECT_TRUE(dot.x >= r && dot.x <= 6.0 - r && dot.y >= r && dot.y <= 4.0 - r);
  }
}

}  // namespace
}  // namespace evenglow::design
