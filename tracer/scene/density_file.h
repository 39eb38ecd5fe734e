#pragma once

#include <filesystem>
#include <vector>

namespace evenglow::tracer {

/// A density map as `density.csv` holds it: a matrix, rows = y from the lowest, columns = x from the lowest; lines that
/// begin with # are comments.
struct DensityMatrix {
  int nx = 0;
  int ny = 0;
  std::vector<double> values;  ///< index iy * nx + ix, each in [0, 1]
};

/// Throws ConfigError, with line and column, for text, numbers outside [0, 1], rows of unequal length, more than
/// 1,000,000 cells, and for what cannot be read.
DensityMatrix read_density_file(const std::filesystem::path& file);

}  // namespace evenglow::tracer
