#include "app/dots_raster.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/cell_index.h"

namespace evenglow::app {

core::CellField coarse_raster(const core::DotPattern& dots, const design::RectangleZone& area, int longest_side) {
  const double length = area.x1 - area.x0, width = area.y1 - area.y0, pixel = std::max(length, width) / longest_side;
  const int nx = std::max(1, static_cast<int>(length / pixel)), ny = std::max(1, static_cast<int>(width / pixel));
  core::CellField share(core::CellGrid::over(nx, ny, area.x0, area.y0, area.x1, area.y1), 0.0);
  const core::CellGrid& g = share.grid;
  for (const core::Dot& dot : dots) {
    const double part =
        core::footprint_area(core::Footprint::round, 2.0 * static_cast<double>(dot.radius)) / g.cell_area();
    const double u = (dot.x - g.x0) / g.dx - 0.5, v = (dot.y - g.y0) / g.dy - 0.5;
    const double iu = std::floor(u), iv = std::floor(v);
    for (int k = 0; k < 4; ++k) {
      const double weight = (k % 2 == 1 ? u - iu : 1.0 - u + iu) * (k / 2 == 1 ? v - iv : 1.0 - v + iv);
      const int ix = std::clamp(static_cast<int>(iu) + k % 2, 0, nx - 1),
                iy = std::clamp(static_cast<int>(iv) + k / 2, 0, ny - 1);
      share.values[core::cell_index(nx, ix, iy)] += part * weight;
    }
  }
  return share;
}

core::CellField fine_raster(const core::DotPattern& dots, core::Footprint footprint,
                            const design::RectangleZone& square, int pixels) {
  core::CellField share(core::CellGrid::over(pixels, pixels, square.x0, square.y0, square.x1, square.y1), 0.0);
  const core::CellGrid& g = share.grid;
  for (const core::Dot& dot : dots) {
    const double r = static_cast<double>(dot.radius), reach = core::footprint_span(footprint, r) + g.dx;
    if (dot.x + reach < square.x0 || dot.x - reach > square.x1 || dot.y + reach < square.y0 ||
        dot.y - reach > square.y1)
      continue;
    const auto column = [&](double x) { return std::clamp(static_cast<int>((x - g.x0) / g.dx), 0, g.nx - 1); };
    const auto row = [&](double y) { return std::clamp(static_cast<int>((y - g.y0) / g.dy), 0, g.ny - 1); };
    const double c = std::cos(static_cast<double>(dot.angle)), s = std::sin(static_cast<double>(dot.angle));
    for (int iy = row(dot.y - reach); iy <= row(dot.y + reach); ++iy) {
      for (int ix = column(dot.x - reach); ix <= column(dot.x + reach); ++ix) {
        const double dx = g.center_x(ix) - dot.x, dy = g.center_y(iy) - dot.y;
        const double distance = footprint == core::Footprint::round
                                    ? std::hypot(dx, dy)
                                    : std::max(std::abs(c * dx + s * dy), std::abs(c * dy - s * dx));
        double& value = share.values[core::cell_index(g.nx, ix, iy)];
        value = std::max(value, std::clamp(0.5 + (r - distance) / g.dx, 0.0, 1.0));
      }
    }
  }
  return share;
}

std::vector<design::RectangleZone> telling_squares(const core::DotPattern& dots, const design::RectangleZone& plate) {
  constexpr int kSide = 24;
  constexpr double kDots = 400.0;
  core::CellField counts(core::CellGrid::over(kSide, kSide, plate.x0, plate.y0, plate.x1, plate.y1), 0.0);
  const core::CellGrid& g = counts.grid;
  for (const core::Dot& dot : dots) counts.values[static_cast<std::size_t>(g.nearest_index(dot.x, dot.y))] += 1.0;
  std::vector<std::size_t> order(g.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return counts.values[i] == 0.0; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return counts.values[a] < counts.values[b]; });
  std::vector<design::RectangleZone> squares;
  for (const double quantile : {0.02, 0.5, 0.98}) {
    const std::size_t cell = order[static_cast<std::size_t>(quantile * static_cast<double>(order.size() - 1))];
    const double most = std::min(plate.x1 - plate.x0, plate.y1 - plate.y0);
    const double half = 0.5 * std::min(most, std::sqrt(kDots * g.cell_area() / counts.values[cell]));
    const double x = std::clamp(g.center_x(static_cast<int>(cell) % kSide), plate.x0 + half, plate.x1 - half);
    const double y = std::clamp(g.center_y(static_cast<int>(cell) / kSide), plate.y0 + half, plate.y1 - half);
    squares.push_back({x - half, x + half, y - half, y + half});
  }
  return squares;
}

}  // namespace evenglow::app
