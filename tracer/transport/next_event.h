#pragma once

#include <optional>

#include "core/light/stokes.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// The next-event estimate of the luminance at the topmost scattering film: what a scatter there is expected to send to
/// the viewer, through the specular films above it with all reflections between these (their light that comes back to
/// the scatterer is traced, not estimated).
class NextEvent {
 public:
  explicit NextEvent(const Scene& scene);

  /// Directions of view drawn at each scatter: what they cost is small beside the walk, and where the lobe of the film
  /// is about as wide as the cone they take out most of the spread that one direction has.
  static constexpr int kDirections = 4;

  /// Score (1/sr) and bin for light that meets the scatterer `surface` at `position`; the direction of view is drawn
  /// from the receiver's cone. Empty: outside the active area, or nothing goes there.
  /// `light` is in the surface's frame, which for films is that of the backlight; `band`: its wavelength.
  std::optional<Score> score(const Bsdf& surface, const core::StokesVector& light, const core::Vec3& position,
                             std::size_t band, core::PhotonRng& rng) const;

  /// Does light that leaves the scatterer at `position` along k go straight up to the viewer, past no side wall and no
  /// edge of a sheet? Only such light is estimated; a photon scattered otherwise must be counted where it leaves.
  bool sees(const core::Vec3& position, const core::Vec3& k, std::size_t band) const;

  /// Transmission (tangential count) of the specular films above for light that travels along k, k.z > 0.
  core::MuellerMatrix transmission(const core::Vec3& k, std::size_t band) const;

 private:
  bool in_front(const core::Vec3& seen) const;
  core::Vec3 display_position(const core::Vec3& position, const core::Vec3& k, std::size_t band) const;

  const Scene& scene_;
};

}  // namespace evenglow::tracer
