#pragma once

#include <vector>

#include "core/math/cell_field.h"

namespace evenglow::design {

struct RectangleZone {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;  ///< mm
};

struct CircleZone {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< mm
};

struct Margins {
  double left = 0.0, right = 0.0, front = 0.0, back = 0.0;  ///< mm
};

/// Where dots may be: a rectangle without some zones. A dot must lie in it whole.
class FreeArea {
 public:
  FreeArea() = default;
  /// `plate`: the whole face, mm. Zones may overlap each other and the margins.
  FreeArea(const RectangleZone& plate, const Margins& margins, std::vector<RectangleZone> rectangles,
           std::vector<CircleZone> circles);

  const RectangleZone& bounds() const { return bounds_; }
  bool has_zones() const { return !rectangles_.empty() || !circles_.empty(); }

  /// Distance (mm) from the point to the nearest border, negative outside the free area; at most `most`.
  double clearance(double x, double y, double most) const;
  /// The same with the direction (unit) in which the clearance grows.
  struct Border {
    double distance = 0.0;
    double nx = 0.0, ny = 0.0;
  };
  /// Calls `visit(Border)` for each border nearer than `reach`.
  template <typename Visit>
  void borders_within(double x, double y, double reach, Visit&& visit) const;

  /// Free share of each cell's area, exact for the margins, by 64 x 64 points a cell for zones.
  core::CellField free_share(const core::CellGrid& cells) const;

 private:
  Border rectangle_border(const RectangleZone& zone, double x, double y) const;
  Border circle_border(const CircleZone& zone, double x, double y) const;

  RectangleZone bounds_;
  std::vector<RectangleZone> rectangles_;
  std::vector<CircleZone> circles_;
};

template <typename Visit>
void FreeArea::borders_within(double x, double y, double reach, Visit&& visit) const {
  if (x - bounds_.x0 < reach) visit(Border{x - bounds_.x0, 1.0, 0.0});
  if (bounds_.x1 - x < reach) visit(Border{bounds_.x1 - x, -1.0, 0.0});
  if (y - bounds_.y0 < reach) visit(Border{y - bounds_.y0, 0.0, 1.0});
  if (bounds_.y1 - y < reach) visit(Border{bounds_.y1 - y, 0.0, -1.0});
  for (const RectangleZone& zone : rectangles_) {
    const Border border = rectangle_border(zone, x, y);
    if (border.distance < reach) visit(border);
  }
  for (const CircleZone& zone : circles_) {
    const Border border = circle_border(zone, x, y);
    if (border.distance < reach) visit(border);
  }
}

}  // namespace evenglow::design
