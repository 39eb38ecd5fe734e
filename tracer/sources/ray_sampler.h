#pragma once

#include <filesystem>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/sources/binary_file.h"
#include "tracer/sources/ray_file_layout.h"

namespace evenglow::tracer {

/// Which axis of a ray file's frame points into the backlight.
enum class RayFileAxis { kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

/// A vector of the file in the right-handed frame whose z points into the backlight.
core::Vec3 into_frame(RayFileAxis axis, const core::Vec3& v);

/// What one pass over the rays of a file found: their flux by blocks, so that a ray can be drawn by its flux with one
/// read of the block's sums and a few reads of the file. Memory: 12 bytes for each of at most 2^20 blocks.
struct RayFlux {
  std::uint64_t rays_per_block = 0;
  std::vector<double> cumulative;  ///< forward flux up to and with each block
  std::vector<float> largest;      ///< largest forward flux of a ray of each block
  double forward = 0.0;            ///< flux of the rays that go into the backlight, more than 1e-6 off its face
  double backward = 0.0;           ///< flux of the rest, which is not emitted
};

/// Reads every ray once and checks it: all numbers finite, |position| < 1e6 mm, |direction| = 1 within 1 %, no negative
/// flux, a valid polarization. Throws `core::ConfigError` for the first that is at fault, and if no light goes forward.
RayFlux scan_rays(const std::filesystem::path& file, const RayFileLayout& layout, RayFileAxis axis);

/// Draws rays of a file with the odds of their flux. Holds the file open; nothing of its rays stays in memory.
class RaySampler {
 public:
  /// Throws `core::ConfigError` if the file is not as long as it was.
  RaySampler(const std::filesystem::path& file, const RayFileLayout& layout, RayFileAxis axis, RayFlux flux);

  /// Position, direction and axis in the frame whose z points into the backlight; direction.z() > 1e-6.
  FileRay sample(core::PhotonRng& rng) const;

 private:
  FileRay ray_at(std::uint64_t index) const;
  FileRay sample_in_block(core::PhotonRng& rng, std::uint64_t first, std::uint64_t count, double largest) const;
  FileRay search_block(double share, std::uint64_t first, std::uint64_t count) const;

  BinaryFile file_;
  RayFileLayout layout_;
  RayFileAxis axis_;
  RayFlux flux_;
};

}  // namespace evenglow::tracer
