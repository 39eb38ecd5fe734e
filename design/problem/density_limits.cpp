#include "design/problem/density_limits.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/math/cell_index.h"

namespace evenglow::design {
namespace {

constexpr int kBisections = 60;
constexpr double kAtLimit = 1e-9;  // relative

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

/// The logarithms of a field as `change` leaves them.
template <typename Change>
void in_logarithms(core::CellField& field, double sign, const Change& change) {
  std::vector<double> logs;
  logs.reserve(field.values.size());
  for (const double value : field.values) logs.push_back(sign * std::log(value));
  const std::vector<double> before = logs;
  change(logs);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (logs[i] != before[i]) field.values[i] = std::exp(sign * logs[i]);
  }
}

/// Both of two mirror images take the tighter limit.
void mirror_limits(bool along_x, CellLimits& limits) {
  const int nx = limits.least.grid.nx, ny = limits.least.grid.ny;
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const std::size_t i = core::cell_index(nx, ix, iy);
      const std::size_t j = along_x ? core::cell_index(nx, nx - 1 - ix, iy) : core::cell_index(nx, ix, ny - 1 - iy);
      limits.largest.values[i] = limits.largest.values[j] =
          std::min(limits.largest.values[i], limits.largest.values[j]);
      limits.least.values[i] = limits.least.values[j] = std::max(limits.least.values[i], limits.least.values[j]);
    }
  }
}

double clamped_mean(const core::CellField& shape, const CellLimits& limits, double scale) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.values.size(); ++i)
    sum += std::clamp(scale * shape.values[i], limits.least.values[i], limits.largest.values[i]);
  return sum / static_cast<double>(shape.values.size());
}

}  // namespace

CellLimits cell_limits(const DesignSpec& spec, const core::CellGrid& cells) {
  CellLimits limits{{cells, spec.density_min}, {cells, spec.density_max}};
  if (!spec.largest_map.empty()) {
    limits.largest = spec.largest_map.over(cells);
    for (double& value : limits.largest.values) value = std::clamp(value, spec.density_min, spec.density_max);
  }
  if (!spec.least_map.empty()) {
    limits.least = spec.least_map.over(cells);
    for (double& value : limits.least.values) value = std::max(value, spec.density_min);
  }
  if (spec.symmetry == "x" || spec.symmetry == "both") mirror_limits(true, limits);
  if (spec.symmetry == "y" || spec.symmetry == "both") mirror_limits(false, limits);
  if (spec.neighbor_ratio) {
    const auto tighten = [&](std::vector<double>& logs) {
      cap_slope(cells.nx, cells.ny, std::log(*spec.neighbor_ratio), logs);
    };
    in_logarithms(limits.largest, 1.0, tighten);
    in_logarithms(limits.least, -1.0, tighten);
  }
  for (std::size_t i = 0; i < limits.least.values.size(); ++i) {
    limits.least.values[i] = std::min(limits.least.values[i], limits.largest.values[i]);
  }
  return limits;
}

tracer::DensityField within(const CellLimits& limits, tracer::DensityField density) {
  for (std::size_t i = 0; i < density.cells.values.size(); ++i) {
    density.cells.values[i] = std::clamp(density.cells.values[i], limits.least.values[i], limits.largest.values[i]);
  }
  return density;
}

double scale_to_mean(const core::CellField& shape, const CellLimits& limits, double mean) {
  const double plain = mean / shape.mean();
  const HeldCells held = held_cells(limits, shape, plain);
  if (held.low + held.high == 0) return plain;
  double low = plain, high = plain;
  while (clamped_mean(shape, limits, low) > mean && low > 1e-6 * plain) low *= 0.5;
  while (clamped_mean(shape, limits, high) < mean && high < 1e6 * plain) high *= 2.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(low * high);
    (clamped_mean(shape, limits, middle) < mean ? low : high) = middle;
  }
  return high;
}

HeldCells held_cells(const CellLimits& limits, const core::CellField& density, double scale) {
  HeldCells held;
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    held.low += scale * density.values[i] < limits.least.values[i] * (1.0 + kAtLimit);
    held.high += scale * density.values[i] > limits.largest.values[i] * (1.0 - kAtLimit);
  }
  return held;
}

void make_symmetric(const DesignSpec& spec, core::CellField& density) {
  if (spec.symmetry == "x" || spec.symmetry == "both") mirror_mean(density, true);
  if (spec.symmetry == "y" || spec.symmetry == "both") mirror_mean(density, false);
}

void limit_neighbor_ratio(double ratio, core::CellField& density) {
  const double slope = std::log(ratio);
  std::vector<double> below;
  below.reserve(density.values.size());
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
