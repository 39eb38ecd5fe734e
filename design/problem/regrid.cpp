#include "design/problem/regrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace evenglow::design {
namespace {

/// Cells of one axis.
struct AxisCells {
  int count;
  double origin;
  double size;
};

/// What one new cell takes of the old ones: weights of cells `first`, `first + 1`, ...
struct Share {
  int first = 0;
  std::vector<double> weights;
};

Share interpolated(const AxisCells& from, double center) {
  const double at = std::clamp((center - from.origin) / from.size - 0.5, 0.0, static_cast<double>(from.count - 1));
  const int low = std::min(static_cast<int>(at), std::max(0, from.count - 2));
  const double part = at - low;
  if (from.count == 1) return {0, {1.0}};
  return {low, {1.0 - part, part}};
}

Share covered(const AxisCells& from, double low, double high) {
  const double end = from.origin + from.count * from.size;
  low = std::clamp(low, from.origin, end);
  high = std::clamp(high, from.origin, end);
  const auto cell_of = [&](double at) {
    return std::clamp(static_cast<int>((at - from.origin) / from.size), 0, from.count - 1);
  };
  Share share{cell_of(low), {}};
  const int last = cell_of(high);
  if (high - low < 1e-9 * from.size) return {share.first, {1.0}};
  for (int i = share.first; i <= last; ++i) {
    const double left = std::max(low, from.origin + i * from.size);
    const double right = std::min(high, from.origin + (i + 1) * from.size);
    share.weights.push_back(std::max(0.0, right - left) / (high - low));
  }
  return share;
}

std::vector<Share> shares(const AxisCells& from, const AxisCells& to) {
  std::vector<Share> result;
  const bool coarser = to.size > from.size * (1.0 + 1e-9);
  for (int i = 0; i < to.count; ++i) {
    const double low = to.origin + i * to.size;
    result.push_back(coarser ? covered(from, low, low + to.size) : interpolated(from, low + 0.5 * to.size));
  }
  return result;
}

}  // namespace

core::CellField regrid(const core::CellField& field, const core::CellGrid& grid) {
  const core::CellGrid& from = field.grid;
  const bool same_place = std::abs(from.x0 - grid.x0) + std::abs(from.y0 - grid.y0) < 1e-9 * (grid.dx + grid.dy);
  const bool same_size = std::abs(from.dx - grid.dx) + std::abs(from.dy - grid.dy) < 1e-9 * (grid.dx + grid.dy);
  if (from.nx == grid.nx && from.ny == grid.ny && same_place && same_size) {
    core::CellField result(grid, 0.0);
    result.values = field.values;
    return result;
  }
  const auto columns = shares({from.nx, from.x0, from.dx}, {grid.nx, grid.x0, grid.dx});
  const auto rows = shares({from.ny, from.y0, from.dy}, {grid.ny, grid.y0, grid.dy});
  std::vector<double> narrow(static_cast<std::size_t>(from.ny) * columns.size(), 0.0);
  for (int iy = 0; iy < from.ny; ++iy) {
    const double* in = field.values.data() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(from.nx);
    double* out = narrow.data() + static_cast<std::size_t>(iy) * columns.size();
    for (std::size_t ix = 0; ix < columns.size(); ++ix) {
      for (std::size_t k = 0; k < columns[ix].weights.size(); ++k) {
        out[ix] += columns[ix].weights[k] * in[static_cast<std::size_t>(columns[ix].first) + k];
      }
    }
  }
  core::CellField result(grid, 0.0);
  for (std::size_t iy = 0; iy < rows.size(); ++iy) {
    double* out = result.values.data() + iy * columns.size();
    for (std::size_t k = 0; k < rows[iy].weights.size(); ++k) {
      const double* in = narrow.data() + (static_cast<std::size_t>(rows[iy].first) + k) * columns.size();
      for (std::size_t ix = 0; ix < columns.size(); ++ix) out[ix] += rows[iy].weights[k] * in[ix];
    }
  }
  return result;
}

}  // namespace evenglow::design
