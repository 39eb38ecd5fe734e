#include "design/problem/density_limits.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/math/cell_index.h"

namespace evenglow::design {
namespace {

/// In place, the greatest field below `values` whose neighbors differ by at most `slope`: two sweeps carry the least
/// value + slope x distance from every cell to every other (distance along the axes).
void cap_slope(int nx, int ny, double slope, std::vector<double>& values) {
  const auto at = [&](int ix, int iy) -> double& { return values[core::cell_index(nx, ix, iy)]; };
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      if (ix > 0) at(ix, iy) = std::min(at(ix, iy), at(ix - 1, iy) + slope);
      if (iy > 0) at(ix, iy) = std::min(at(ix, iy), at(ix, iy - 1) + slope);
    }
  }
  for (int iy = ny - 1; iy >= 0; --iy) {
    for (int ix = nx - 1; ix >= 0; --ix) {
      if (ix + 1 < nx) at(ix, iy) = std::min(at(ix, iy), at(ix + 1, iy) + slope);
      if (iy + 1 < ny) at(ix, iy) = std::min(at(ix, iy), at(ix, iy + 1) + slope);
    }
  }
}

void mirror_mean(core::CellField& field, bool along_x) {
  const int nx = field.grid.nx;
  const int ny = field.grid.ny;
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const auto i = core::cell_index(nx, ix, iy);
      const auto j = static_cast<std::size_t>(along_x ? iy * nx + (nx - 1 - ix) : (ny - 1 - iy) * nx + ix);
      if (j <= i) continue;
      field.values[i] = field.values[j] = std::sqrt(field.values[i] * field.values[j]);
    }
  }
}

}  // namespace

CellLimits cell_limits(const DesignSpec& spec, const core::CellGrid& cells) {
  CellLimits limits{{cells, spec.density_min}, {cells, spec.density_max}};
  if (!spec.largest_map.empty()) {
    limits.largest = spec.largest_map.over(cells);
    for (double& value : limits.largest.values) value = std::clamp(value, spec.density_min, spec.density_max);
  }
  if (!spec.least_map.empty()) limits.least = spec.least_map.over(cells);
  for (std::size_t i = 0; i < limits.least.values.size(); ++i) {
    double& least = limits.least.values[i];
    least = std::min(std::max(least, spec.density_min), limits.largest.values[i]);
  }
  return limits;
}

tracer::DensityField within(const CellLimits& limits, tracer::DensityField density) {
  for (std::size_t i = 0; i < density.cells.values.size(); ++i) {
    density.cells.values[i] = std::clamp(density.cells.values[i], limits.least.values[i], limits.largest.values[i]);
  }
  return density;
}

void make_symmetric(const DesignSpec& spec, core::CellField& density) {
  if (spec.symmetry == "x" || spec.symmetry == "both") mirror_mean(density, true);
  if (spec.symmetry == "y" || spec.symmetry == "both") mirror_mean(density, false);
}

void limit_neighbor_ratio(double ratio, core::CellField& density) {
  const double slope = std::log(ratio);
  std::vector<double> below;
  for (const double value : density.values) below.push_back(std::log(value));
  std::vector<double> above = below;
  cap_slope(density.grid.nx, density.grid.ny, slope, below);
  for (double& value : above) value = -value;
  cap_slope(density.grid.nx, density.grid.ny, slope, above);
  for (std::size_t i = 0; i < below.size(); ++i) {
    const double mean = 0.5 * (below[i] - above[i]);
    // The logarithm and back would change the last bits of a field that keeps the bound.
    if (below[i] != -above[i]) density.values[i] = std::exp(mean);
  }
}

}  // namespace evenglow::design
