#pragma once

#include <filesystem>
#include <vector>

namespace evenglow::core {

/// Numbers over a rectangle: a density, a luminance, a mask.
struct NumberMatrix {
  int nx = 0;
  int ny = 0;
  std::vector<double> values;  ///< index iy * nx + ix, rows = y from the lowest

  bool empty() const { return values.empty(); }
};

/// What the numbers may be.
struct MatrixRange {
  double least = 0.0;
  double largest = 1.0;
  const char* what = "a number";  ///< for messages: `a density in [0, 1]`
};

/// A matrix as text, in the form of density.csv and luminance.csv: rows = y from the lowest, columns = x from the
/// lowest, commas between; lines that begin with # are comments. Throws ConfigError, with line and column, for text,
/// numbers out of the range, rows of unequal length, more than 1,000,000 cells, and for what cannot be read.
NumberMatrix read_matrix_csv(const std::filesystem::path& file, const MatrixRange& range);

/// A picture, from black (0) to white (1), linear in the stored value; its lowest row has the lowest y. At most 4096 x
/// 4096 pixels; ConfigError for what is larger, damaged, or of another kind.
///
/// PNG of 8 bits a color: the mean of red, green and blue; transparent is black.
NumberMatrix read_png_picture(const std::filesystem::path& file);
/// TIFF: gray of 8 or 16 bits (0 is black or white, as the file says) or of 32-bit floating point numbers, which count
/// as they are and must lie in [0, 1]; else the mean of red, green and blue at 8 bits, as of PNG.
NumberMatrix read_tiff_picture(const std::filesystem::path& file);
/// Either, by its first bytes.
NumberMatrix read_picture(const std::filesystem::path& file);
/// Do the first bytes of the file say that it is a PNG or TIFF picture? False for what cannot be read.
bool is_picture(const std::filesystem::path& file);

}  // namespace evenglow::core
