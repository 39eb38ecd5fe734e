#include "design/dots/coverage_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/cell_index.h"

namespace evenglow::design {
namespace {

constexpr int kSteps = 4;

/// Mean over each cell of what is bilinear between the values: weights 1/8, 3/4, 1/8 in x and in y.
core::CellField cell_means(const core::CellField& nodes) {
  const core::CellGrid& g = nodes.grid;
  core::CellField rows = nodes, means = nodes;
  const auto at = [&g](int ix, int iy) {
    return static_cast<std::size_t>(std::clamp(iy, 0, g.ny - 1) * g.nx + std::clamp(ix, 0, g.nx - 1));
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    for (int ix = 0; ix < g.nx; ++ix) {
      rows.values[at(ix, iy)] =
          0.75 * nodes.values[at(ix, iy)] + 0.125 * (nodes.values[at(ix - 1, iy)] + nodes.values[at(ix + 1, iy)]);
    }
  }
  for (int iy = 0; iy < g.ny; ++iy) {
    for (int ix = 0; ix < g.nx; ++ix) {
      means.values[at(ix, iy)] =
          0.75 * rows.values[at(ix, iy)] + 0.125 * (rows.values[at(ix, iy - 1)] + rows.values[at(ix, iy + 1)]);
    }
  }
  return means;
}

}  // namespace

CoverageMap::CoverageMap(core::CellField coverage, FreeArea free)
    : coverage_(std::move(coverage)),
      free_(std::move(free)),
      free_share_(free_.free_share(coverage_.grid)),
      nodes_(coverage_) {
  for (int step = 0; step < kSteps; ++step) {
    const core::CellField means = cell_means(nodes_);
    for (std::size_t i = 0; i < nodes_.values.size(); ++i) {
      const double wanted = coverage_.values[i];
      nodes_.values[i] =
          std::clamp(nodes_.values[i] + wanted - means.values[i], 0.5 * wanted, std::min(1.0, 2.0 * wanted));
    }
  }
}

double CoverageMap::wanted_in_all() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < coverage_.values.size(); ++i) sum += wanted(i);
  return sum;
}

double CoverageMap::at(double x, double y) const {
  const core::CellGrid& g = nodes_.grid;
  const double u = std::clamp((x - g.x0) / g.dx - 0.5, 0.0, g.nx - 1.0);
  const double v = std::clamp((y - g.y0) / g.dy - 0.5, 0.0, g.ny - 1.0);
  const int ix = std::min(static_cast<int>(u), std::max(g.nx - 2, 0)),
            iy = std::min(static_cast<int>(v), std::max(g.ny - 2, 0));
  const double a = u - ix, b = v - iy;
  const int right = g.nx > 1 ? 1 : 0, up = g.ny > 1 ? g.nx : 0;
  const double* value = &nodes_.values[core::cell_index(g.nx, ix, iy)];
  return (1.0 - b) * ((1.0 - a) * value[0] + a * value[right]) + b * ((1.0 - a) * value[up] + a * value[up + right]);
}

}  // namespace evenglow::design
