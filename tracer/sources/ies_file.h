#pragma once

#include <filesystem>

#include "tracer/sources/intensity_table.h"

namespace evenglow::tracer {

/// Reads an IES file (ANSI/IESNA LM-63-1986, -1991, -1995, -2002, -2019) of type C photometry: intensities in cd, all
/// factors of the file multiplied in. Its lumens per lamp are not needed, as the intensities are those of the source
/// itself.
///
/// - TILT=NONE or TILT=INCLUDE (then the factor of tilt 0); TILT of another file is refused.
/// - Candela multiplier x ballast factor, in files before 1995 also x ballast-lamp photometric factor.
/// - Horizontal angles 0 alone (rotation), 0 to 90 (quadrant), 0 to 180, 90 to 270 (half) or 0 to 360; vertical angles
///   from 0 or 90 on; 1,000,000 intensities at most.
///
/// Throws `core::ConfigError` with file, line and column.
IntensityTable read_ies_file(const std::filesystem::path& file);

}  // namespace evenglow::tracer
