#pragma once

#include <filesystem>
#include <vector>

#include "core/math/cell_field.h"

namespace evenglow::design {

/// A map of the run file's user: a matrix that is stretched over a rectangle of the backlight.
struct MapTable {
  int nx = 0;
  int ny = 0;
  std::vector<double> values;  ///< index iy * nx + ix, rows = y from the lowest

  bool empty() const { return values.empty(); }
  /// The map over the rectangle of these cells, on these cells (regrid.h).
  core::CellField over(const core::CellGrid& grid) const;
};

/// What the numbers of a map may be.
struct MapRange {
  double least = 0.0;
  double largest = 1.0;
  const char* what = "a number";  ///< for messages: `a density in [0, 1]`
};

/// Reads a CSV matrix: rows = y from the lowest, columns = x from the lowest; lines that begin with # are comments (the
/// form of density.csv and luminance.csv). Throws ConfigError, with line and column, for text, numbers out of the
/// range, rows of unequal length, more than 1,000,000 cells, and for what cannot be read.
MapTable read_map_csv(const std::filesystem::path& file, const MapRange& range);

/// Reads a PNG picture: the mean of red, green and blue of each pixel, 0 (black) to 1 (white), linear in the stored
/// value; transparent is black. The lowest row of the picture has the lowest y. Throws ConfigError if it is no PNG
/// picture of at most 4096 x 4096 pixels.
MapTable read_map_png(const std::filesystem::path& file);

}  // namespace evenglow::design
