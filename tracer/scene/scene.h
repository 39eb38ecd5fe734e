#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec3.h"
#include "tracer/geometry/mesh.h"
#include "tracer/geometry/ray_caster.h"
#include "tracer/optics/bsdf.h"
#include "tracer/optics/volume_scattering.h"
#include "tracer/receivers/angular_receiver.h"
#include "tracer/receivers/flux_receiver.h"
#include "tracer/receivers/luminance_receiver.h"
#include "tracer/scene/backlight_spec.h"
#include "tracer/scene/spectral_bands.h"
#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// A rectangle of a surface with optics of its own (an LED in its frame), in coordinates along the surface's x and y
/// axes.
struct SurfaceWindow {
  double min_x, max_x, min_y, max_y;  ///< mm
  const Bsdf* optics;
  int part;
};

/// What a quad of the ray caster is.
struct Surface {
  core::Vec3 x = core::Vec3::UnitX(), y = core::Vec3::UnitY(),
             normal =
                 core::Vec3::UnitZ();  ///< local axes, right-handed; the normal of a body's face points out of the body
  const Bsdf* optics = nullptr;
  const Bsdf* pattern = nullptr;  ///< microstructure that the density field rules, or null
  int part = 0;                   ///< who absorbs, index in the energy account
  int pattern_part = 0;
  int body = -1;  ///< the dielectric body that this face bounds, -1: none
  std::vector<SurfaceWindow> windows;
  /// The wall of a wedge: only where `trim_normal` . p >= trim_offset; zero normal: everywhere.
  core::Vec3 trim_normal = core::Vec3::Zero();
  double trim_offset = 0.0;

  bool is_trimmed() const { return trim_normal.z() != 0.0; }
  bool holds(const core::Vec3& p) const { return trim_normal.dot(p) >= trim_offset; }
};

/// A dielectric body.
struct Body {
  double refractive_index = 1.0;
  double absorption = 0.0;  ///< 1/mm
  int part = 0;
  std::optional<VolumeScattering> scattering{};
};

/// All that the wavelength decides, for one band of wavelengths.
struct SceneOptics {
  std::vector<Surface> surfaces;  ///< of each quad
  std::vector<Body> bodies;
  std::vector<std::unique_ptr<const Bsdf>> owned;  ///< what was made for this wavelength
};

/// Where the photons of a source start: on a quad of their own, on one of a row of quads (the photon's `quad` counts
/// from the first), or on none.
struct SourcePlacement {
  int first_quad = -1;
  bool quad_per_window = false;
};

/// A compiled backlight: immutable, shared by all photons. What the designer turns, the DensityField, is not part of
/// it.
struct Scene {
  BacklightSpec spec;  ///< owns films, reflectors, shapes and sources
  Box box;             ///< what leaves it has left the backlight
  std::unique_ptr<RayCaster> caster;
  SpectralBands bands;
  std::vector<SceneOptics> optics;                 ///< of each band
  std::vector<SourcePlacement> source_placements;  ///< of each source
  double flux = 0.0;                               ///< lm, all sources
  LuminanceReceiver luminance;
  FluxReceiver energy;
  std::optional<AngularReceiver> angular;
};

/// The density field that the run file starts from; one cell of zero density without microstructure.
struct DensityField;
DensityField initial_density(const BacklightSpec& spec);

/// Meshes, optics, sources and receivers of a backlight.
Scene compile_scene(BacklightSpec spec);

}  // namespace evenglow::tracer
