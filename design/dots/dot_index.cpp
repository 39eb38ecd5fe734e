#include "design/dots/dot_index.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {

RectangleZone bounds_of(const core::DotPattern& dots) {
  core::expects(!dots.empty(), "a pattern has dots");
  RectangleZone box{dots[0].x, dots[0].x, dots[0].y, dots[0].y};
  for (const core::Dot& dot : dots) {
    const double r = dot.radius;
    box = {std::min(box.x0, dot.x - r), std::max(box.x1, dot.x + r), std::min(box.y0, dot.y - r),
           std::max(box.y1, dot.y + r)};
  }
  return box;
}

DotStore index_dots(const core::DotPattern& dots, const RectangleZone& area, int threads) {
  constexpr double kDotsPerCell = 50.0;
  constexpr double kMostCells = 1000.0;  // along one side
  const double length = area.x1 - area.x0, width = area.y1 - area.y0;
  const double size = std::sqrt(length * width * kDotsPerCell / static_cast<double>(dots.size()));
  const auto cells = [&](double side) { return static_cast<int>(std::clamp(side / size, 1.0, kMostCells)); };
  const auto grid = core::CellGrid::over(cells(length), cells(width), area.x0, area.y0, area.x1, area.y1);
  std::vector<int> counts(grid.size(), 0);
  counts[0] = static_cast<int>(dots.size());
  DotStore store(grid, counts);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    store.dots().x[i] = dots[i].x;
    store.dots().y[i] = dots[i].y;
    store.dots().diameter[i] = 2.0f * dots[i].radius;
    store.dots().spacing[i] = static_cast<float>(size / std::sqrt(kDotsPerCell));
  }
  store.sort_all(threads);
  return store;
}

}  // namespace evenglow::design
