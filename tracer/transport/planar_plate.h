#pragma once

#include <array>
#include <optional>

#include "tracer/scene/scene.h"
#include "tracer/transport/planar_scene.h"

namespace evenglow::tracer {

/// An opaque reflector (OpaqueReflector) that a walk meets so often that it is worked out in place.
struct PlainReflector {
  bool known = false;
  double reflectance = 0.0;
  double mirrored = 0.0;  ///< share of the incident light
  int part = 0;
  double per_mirrored = 0.0;   ///< 1 / mirrored, if there is any
  double per_scattered = 0.0;  ///< 1 / (reflectance - mirrored), likewise

  /// A uniform number again, of one that has turned out to lie between `mirrored` and `reflectance`.
  double again(double uniform) const { return (uniform - mirrored) * per_scattered; }

  static PlainReflector of(const Bsdf* optics, int part);
};

/// What stands close behind a smooth wall of the plate: nothing known, or a plain reflector across a gap of air.
struct WallBacking {
  PlainReflector reflector;
  double gap = 0.0;  ///< mm
  int quad = -1;
};

/// What a walk inside the plate needs of it at one wavelength.
struct PlanarPlate {
  Box box;
  core::Vec3 center = core::Vec3::Zero(), half = core::Vec3::Zero();  ///< of the box, and half its edges
  std::array<double, kSides> planes{};                                ///< of the box
  int body = 0;
  double refractive_index = 1.5;
  double per_index = 1.0 / 1.5;           ///< 1 / refractive_index
  double height = 1.0, per_height = 1.0;  ///< mm, 1/mm
  double absorption = 0.0;                ///< 1/mm
  int part = 0;
  std::array<int, kSides> quads{};
  std::array<bool, 4> smooth{};  ///< is this wall a smooth face, or has it other optics?
  std::array<WallBacking, 4> backings;
  bool open_above = false;        ///< light that leaves the top meets nothing more
  const Bsdf* pattern = nullptr;  ///< microstructure, or null
  PlainReflector dots;            ///< the same if it is plain
  int pattern_part = 0;
  int pattern_side = -1;  ///< bottom or top; -1: none

  /// For band `band`; empty without a plate, or where the plate's own faces or its bulk are of another kind: then each
  /// of its faces is met one by one.
  static std::optional<PlanarPlate> of(const Scene& scene, const PlanarScene& layout, std::size_t band);

  /// Side of a quad of the plate, -1: another's.
  int side_of(int quad) const {
    for (int side = 0; side < kSides; ++side) {
      if (quads[static_cast<std::size_t>(side)] == quad) return side;
    }
    return -1;
  }
};

}  // namespace evenglow::tracer
