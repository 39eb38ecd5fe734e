#pragma once

#include <filesystem>

#include "tracer/sources/intensity_table.h"

namespace evenglow::tracer {

struct IntensityCsv {
  IntensityTable table;
  bool absolute = false;  ///< in cd; else only the shape counts
};

/// Reads a CSV table of intensity against polar angle and azimuth: columns `theta_deg` (from the normal, 0 to 180),
/// `phi_deg` (may be left out: rotation) and either `intensity` (any unit) or `intensity_cd`. Every theta of the file
/// must stand with every phi, once; the order of the rows does not matter. The azimuths are 0 alone or run from 0 to
/// 90, 180 or 360, or from 90 to 270, and stand for the whole circle as in type C photometry. 1,000,000 rows at most.
///
/// Throws `core::ConfigError` with file and line.
IntensityCsv read_intensity_csv(const std::filesystem::path& file);

}  // namespace evenglow::tracer
