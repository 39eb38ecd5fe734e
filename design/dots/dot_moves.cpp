#include "design/dots/dot_moves.h"

#include "design/dots/cell_corner.h"

namespace evenglow::design {
namespace {

double within(double from, double to, double low, double high) {
  if (to < low) return 0.5 * (from + low);
  if (to > high) return 0.5 * (from + high);
  return to;
}

}  // namespace

void move_free(const DotSpec& spec, const CoverageMap& map, double dx, double dy, float diameter, double& x,
               double& y) {
  const double half = 0.5 * core::footprint_span(spec.footprint, diameter);
  const auto free = [&](double at_x, double at_y) { return map.free().clearance(at_x, at_y, 2.0 * half) >= half; };
  if (free(x + dx, y + dy)) {
    x += dx;
    y += dy;
  } else if (free(x + dx, y)) {
    x += dx;
  } else if (free(x, y + dy)) {
    y += dy;
  }
}

void move_within(const DotSpec& spec, const CoverageMap& map, std::size_t cell, double dx, double dy, float diameter,
                 double& x, double& y) {
  const core::CellGrid& g = map.grid();
  const auto [x0, y0] = cell_corner(g, cell);
  move_free(spec, map, within(x, x + dx, x0, x0 + g.dx) - x, within(y, y + dy, y0, y0 + g.dy) - y, diameter, x, y);
}

}  // namespace evenglow::design
