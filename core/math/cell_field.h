#pragma once

#include <cstddef>
#include <vector>

namespace evenglow::core {

/// A rectangle [x0, x0 + nx dx] x [y0, y0 + ny dy] (mm) cut into nx x ny equal cells. Cell (ix, iy) has the index
/// iy * nx + ix: rows are y, columns are x.
struct CellGrid {
  int nx = 1;
  int ny = 1;
  double x0 = 0.0;  ///< mm
  double y0 = 0.0;  ///< mm
  double dx = 1.0;  ///< mm, > 0
  double dy = 1.0;  ///< mm, > 0

  static CellGrid over(int nx, int ny, double x0, double y0, double x1, double y1);

  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  double cell_area() const { return dx * dy; }                    ///< mm2
  double center_x(int ix) const { return x0 + (ix + 0.5) * dx; }  ///< mm
  double center_y(int iy) const { return y0 + (iy + 0.5) * dy; }  ///< mm
  /// Index of the cell that holds the point, or -1 outside.
  int index_at(double x, double y) const;
  /// Index of the cell nearest to the point.
  int nearest_index(double x, double y) const;

  bool operator==(const CellGrid&) const = default;
};

/// A value for each cell of a grid.
struct CellField {
  CellGrid grid;
  std::vector<double> values;  ///< size grid.size(), index iy * nx + ix

  CellField() = default;
  CellField(const CellGrid& cells, double value) : grid(cells), values(cells.size(), value) {}

  double mean() const;
  double min() const;
  double max() const;
  /// Value of the nearest cell.
  double at(double x, double y) const { return values[static_cast<std::size_t>(grid.nearest_index(x, y))]; }
};

/// The field on another grid: the value of the nearest cell at each new cell's center.
CellField resample_nearest(const CellField& field, const CellGrid& grid);

/// The field on another grid, bilinear between the centers of its cells, constant beyond the outermost centers.
CellField resample_bilinear(const CellField& field, const CellGrid& grid);

/// The field smoothed by a Gaussian of `sigma_x` and `sigma_y` (in cells; 0: not smoothed in that direction),
/// reflecting at the borders, so that the sum of the values is kept.
CellField smooth_gaussian(const CellField& field, double sigma_x, double sigma_y);
inline CellField smooth_gaussian(const CellField& field, double sigma) {
  return smooth_gaussian(field, sigma, sigma);
}

}  // namespace evenglow::core
