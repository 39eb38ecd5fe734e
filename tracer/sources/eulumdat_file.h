#pragma once

#include <filesystem>

#include "tracer/sources/intensity_table.h"

namespace evenglow::tracer {

/// Reads an EULUMDAT file (.ldt; A. W. Stockmar, "EULUMDAT - ein Leuchtendatenformat fuer den europaeischen
/// Beleuchtungsplaner", Licht '90): intensities in cd, that is cd per 1000 lm x the flux of the first set of lamps x
/// the file's conversion factor. A negative number of lamps marks absolute photometry; the flux counts the same.
///
/// Isym 0 (no symmetry), 1 (rotation), 2 (plane C0-C180), 3 (plane C90-C270), 4 (both); gamma from 0 on;
/// 1,000,000 intensities at most. C and gamma angles count as listed, the distances Dc and Dg are not needed.
///
/// Throws `core::ConfigError` with file, line and column.
IntensityTable read_eulumdat_file(const std::filesystem::path& file);

}  // namespace evenglow::tracer
