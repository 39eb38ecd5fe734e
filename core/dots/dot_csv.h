#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/dots/dot.h"

namespace evenglow::core {

/// First lines of a dots.csv: a comment with the units and the names of the columns.
inline constexpr std::string_view kDotColumns = "x_mm,y_mm,diameter_um,angle_deg";

/// Reads the dots of a CSV file: columns `x_mm`, `y_mm`, `diameter_um` (width of a square footprint) and, if given,
/// `angle_deg`, in any order; lines that begin with # are comments. Throws ConfigError, `file:line:column: ...`, as
/// `CsvNumbers` does (256 MB at most: about 6 million dots), and for a file without dots.
DotPattern read_dot_csv(const std::filesystem::path& file);
DotPattern parse_dot_csv(std::string_view text, std::string name);

}  // namespace evenglow::core
