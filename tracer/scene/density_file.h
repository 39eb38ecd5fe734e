#pragma once

#include <filesystem>

#include "core/config/matrix_file.h"

namespace evenglow::tracer {

/// A density map, each value in [0, 1]: a matrix in the form of density.csv, or a PNG or TIFF picture (black 0, white
/// 1). Throws ConfigError, with line and column, for what is neither, for numbers outside [0, 1] and for more than
/// 1,000,000 cells.
core::NumberMatrix read_density_file(const std::filesystem::path& file);

}  // namespace evenglow::tracer
