#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// The density of microstructure in each cell, found without a division.
class PlanarCells {
 public:
  using Band = PlanarCells;
  /// Does the pattern let light go elsewhere than where it came?
  static constexpr bool kMovesLight = false;
  PlanarCells(const Scene&, const DensityField& density) : PlanarCells(density) {}
  /// The same at all wavelengths.
  const PlanarCells& of(std::size_t) const { return *this; }

  explicit PlanarCells(const DensityField& density)
      : x0_(density.cells.grid.x0),
        y0_(density.cells.grid.y0),
        per_x_(1.0 / density.cells.grid.dx),
        per_y_(1.0 / density.cells.grid.dy),
        nx_(density.cells.grid.nx),
        ny_(density.cells.grid.ny) {
    for (const double share : density.cells.values) {
      open_.push_back(1.0 - share);
      depths_.push_back(-std::log1p(-share));
    }
  }

  /// Places in units of cells, and the nearest cell to such a place.
  double column(double x) const { return (x - x0_) * per_x_; }
  double row(double y) const { return (y - y0_) * per_y_; }
  double columns_per(double dx) const { return dx * per_x_; }
  double rows_per(double dy) const { return dy * per_y_; }
  [[gnu::always_inline]] std::size_t cell(double column, double row) const {
    const int ix = held(static_cast<int>(column), nx_), iy = held(static_cast<int>(row), ny_);
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }

  /// The same for light that comes to the face, in general and from inside; its direction does not matter here.
  template <typename Light>
  [[gnu::always_inline]] std::size_t cell_met(double column, double row, const Light&) const {
    return cell(column, row);
  }
  template <typename Light>
  [[gnu::always_inline]] std::size_t cell_inside(double column, double row, const Light&) const {
    return cell(column, row);
  }

  /// 1 - density: what of the cell is bare.
  double open(std::size_t cell) const { return open_[cell]; }
  /// -ln(1 - density).
  double depth(std::size_t cell) const { return depths_[cell]; }

 private:
  /// Nearly all are in the range: one comparison, and a branch that is seldom taken.
  [[gnu::always_inline]] static int held(int index, int count) {
    if (static_cast<unsigned>(index) < static_cast<unsigned>(count)) [[likely]]
      return index;
    return index < 0 ? 0 : count - 1;
  }

  double x0_, y0_, per_x_, per_y_;
  int nx_, ny_;
  std::vector<double> open_, depths_;
};

}  // namespace evenglow::tracer
