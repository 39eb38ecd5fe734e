#include "design/dots/keep_out.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/cell_index.h"

namespace evenglow::design {

FreeArea::FreeArea(const RectangleZone& plate, const Margins& margins, std::vector<RectangleZone> rectangles,
                   std::vector<CircleZone> circles)
    : bounds_{plate.x0 + margins.left, plate.x1 - margins.right, plate.y0 + margins.front, plate.y1 - margins.back},
      rectangles_(std::move(rectangles)),
      circles_(std::move(circles)) {}

FreeArea::Border FreeArea::rectangle_border(const RectangleZone& zone, double x, double y) const {
  const double near_x = std::clamp(x, zone.x0, zone.x1), near_y = std::clamp(y, zone.y0, zone.y1);
  const double dx = x - near_x, dy = y - near_y;
  const double distance = std::hypot(dx, dy);
  if (distance > 0.0) return {distance, dx / distance, dy / distance};
  Border border{-(x - zone.x0), -1.0, 0.0};
  const Border others[] = {{-(zone.x1 - x), 1.0, 0.0}, {-(y - zone.y0), 0.0, -1.0}, {-(zone.y1 - y), 0.0, 1.0}};
  for (const Border& other : others) {
    if (other.distance > border.distance) border = other;
  }
  return border;
}

FreeArea::Border FreeArea::circle_border(const CircleZone& zone, double x, double y) const {
  const double dx = x - zone.x, dy = y - zone.y;
  const double distance = std::hypot(dx, dy);
  if (distance == 0.0) return {-zone.radius, 1.0, 0.0};
  return {distance - zone.radius, dx / distance, dy / distance};
}

double FreeArea::clearance(double x, double y, double most) const {
  double least = most;
  borders_within(x, y, most, [&](const Border& border) { least = std::min(least, border.distance); });
  return least;
}

core::CellField FreeArea::free_share(const core::CellGrid& cells) const {
  constexpr int kPoints = 64;
  core::CellField share(cells, 0.0);
  for (int iy = 0; iy < cells.ny; ++iy) {
    for (int ix = 0; ix < cells.nx; ++ix) {
      const double x0 = std::max(cells.x0 + ix * cells.dx, bounds_.x0),
                   y0 = std::max(cells.y0 + iy * cells.dy, bounds_.y0);
      const double x1 = std::min(cells.x0 + (ix + 1) * cells.dx, bounds_.x1);
      const double y1 = std::min(cells.y0 + (iy + 1) * cells.dy, bounds_.y1);
      if (x1 <= x0 || y1 <= y0) continue;
      const double part = std::min(1.0, (x1 - x0) * (y1 - y0) / cells.cell_area());
      const double reach = std::hypot(x1 - x0, y1 - y0);
      const auto index = core::cell_index(cells.nx, ix, iy);
      share.values[index] = part;
      bool touched = false;
      const double mid_x = 0.5 * (x0 + x1), mid_y = 0.5 * (y0 + y1);
      for (const RectangleZone& zone : rectangles_) touched |= rectangle_border(zone, mid_x, mid_y).distance < reach;
      for (const CircleZone& zone : circles_) touched |= circle_border(zone, mid_x, mid_y).distance < reach;
      if (!touched) continue;
      int inside = 0;
      for (int j = 0; j < kPoints; ++j) {
        for (int i = 0; i < kPoints; ++i) {
          const double x = x0 + (i + 0.5) / kPoints * (x1 - x0), y = y0 + (j + 0.5) / kPoints * (y1 - y0);
          inside += clearance(x, y, 1.0) > 0.0;
        }
      }
      share.values[index] = part * inside / (kPoints * kPoints);
    }
  }
  return share;
}

}  // namespace evenglow::design
