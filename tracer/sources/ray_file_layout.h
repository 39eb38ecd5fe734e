#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec3.h"

namespace evenglow::tracer {

/// Where the numbers of a ray stand in a binary ray file: little-endian 32-bit floats, one record after the other.
struct RayFileLayout {
  std::string format;            ///< `tm25`, `zemax`
  std::uint64_t first_byte = 0;  ///< of the first record
  std::uint64_t rays = 0;
  int columns = 7;            ///< numbers of a record; x, y, z and the direction come first
  int flux = 6;               ///< column of the flux that weighs the rays
  bool lumens = false;        ///< the flux is in lm, else in W
  std::optional<int> stokes;  ///< column of S1, S2, S3 and of the axis they count from, three more
  double mm_per_unit = 1.0;   ///< of the positions
  /// Luminous flux (lm) of all rays as the head tells it; none if it does not.
  std::optional<double> head_flux;

  std::uint64_t record_bytes() const { return 4 * static_cast<std::uint64_t>(columns); }
};

/// One ray in the frame of its file.
struct FileRay {
  core::Vec3 position;                     ///< mm
  core::Vec3 direction;                    ///< unit
  double flux = 0.0;                       ///< lm or W
  core::Vec3 stokes = core::Vec3::Zero();  ///< S1, S2, S3 over S0
  core::Vec3 axis = core::Vec3::Zero();    ///< of S1; zero: not polarized
};

/// Reads the head of an IES TM-25-13 file (`TM25`, version 2013): positions in mm, the flux in lm where the rays have
/// one, else in W; Stokes parameters if the file has them. `size` is that of the file.
/// Throws `core::ConfigError` for anything else, and if the records do not end where the file ends.
RayFileLayout read_tm25_head(const std::filesystem::path& file);

/// Reads the head (208 bytes) of a Zemax binary source file (.dat, .sdf): identifier 1010 or 8675309, flux-only (7
/// numbers) or spectral color format (8), units m, in, cm, ft or mm, flux in W or lm. Errors as above.
RayFileLayout read_zemax_head(const std::filesystem::path& file);

/// Tells the format by the first four bytes, or takes the given one (`tm25`, `zemax`; `auto`).
RayFileLayout read_ray_file_head(const std::filesystem::path& file, const std::string& format);

}  // namespace evenglow::tracer
