#include "design/updaters/coarse_basis.h"

#include <algorithm>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// Between the nodes `low` and `low + 1` (the same at the ends), `share` of the way.
struct Between {
  int low = 0, high = 0;
  float share = 0.0F;
};

Between between(double position, int count) {
  const double at = std::clamp(position, 0.0, count - 1.0);
  const int low = std::min(static_cast<int>(at), std::max(0, count - 2));
  return {low, std::min(low + 1, count - 1), static_cast<float>(at - low)};
}

}  // namespace

CoarseBasis::CoarseBasis(const core::CellGrid& cells, int nx, int ny)
    : cells_(cells),
      nodes_(core::CellGrid::over(nx, ny, cells.x0, cells.y0, cells.x0 + cells.nx * cells.dx,
                                  cells.y0 + cells.ny * cells.dy)) {
  directions_.count = nodes_.size();
  for (int iy = 0; iy < cells.ny; ++iy) {
    const Between y = between((cells.center_y(iy) - nodes_.y0) / nodes_.dy - 0.5, ny);
    for (int ix = 0; ix < cells.nx; ++ix) {
      const Between x = between((cells.center_x(ix) - nodes_.x0) / nodes_.dx - 0.5, nx);
      const auto node = [&](int i, int j) { return static_cast<std::uint32_t>(j * nx + i); };
      directions_.of_cell.push_back({{{node(x.low, y.low), (1.0F - x.share) * (1.0F - y.share)},
                                      {node(x.high, y.low), x.share * (1.0F - y.share)},
                                      {node(x.low, y.high), (1.0F - x.share) * y.share},
                                      {node(x.high, y.high), x.share * y.share}}});
    }
  }
}

core::CellField CoarseBasis::field(const std::vector<double>& values) const {
  core::expects(values.size() == count(), "a value for each node");
  core::CellField result(cells_, 0.0);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    for (const auto& part : directions_.of_cell[i])
      result.values[i] += static_cast<double>(part.weight) * values[part.direction];
  }
  return result;
}

std::vector<double> CoarseBasis::means(const core::CellField& field) const {
  std::vector<double> sums(count(), 0.0), weights(count(), 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    for (const auto& part : directions_.of_cell[i]) {
      sums[part.direction] += static_cast<double>(part.weight) * field.values[i];
      weights[part.direction] += static_cast<double>(part.weight);
    }
  }
  for (std::size_t j = 0; j < sums.size(); ++j) sums[j] = weights[j] > 0.0 ? sums[j] / weights[j] : 0.0;
  return sums;
}

std::vector<std::uint32_t> CoarseBasis::nearest_node(const core::CellGrid& display) const {
  std::vector<std::uint32_t> nearest;
  for (int iy = 0; iy < display.ny; ++iy) {
    for (int ix = 0; ix < display.nx; ++ix)
      nearest.push_back(static_cast<std::uint32_t>(nodes_.nearest_index(display.center_x(ix), display.center_y(iy))));
  }
  return nearest;
}

}  // namespace evenglow::design
