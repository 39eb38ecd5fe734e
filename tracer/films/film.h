#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/volume_scattering.h"

namespace evenglow::tracer {

/// Body of a plain sheet whose two smooth faces the scene makes.
struct DielectricSheet {
  double refractive_index = 1.5;
  double absorption = 0.0;  ///< 1/mm
  double thickness = 0.1;   ///< mm
  std::optional<VolumeScattering> scattering{};
};

/// What a film is to light of one wavelength: one of the two.
struct FilmOptics {
  std::unique_ptr<const Bsdf> surface;
  std::optional<DielectricSheet> sheet;
};

/// One film of the stack above the plate: a thin surface, or a sheet with a body.
struct Film {
  std::string kind;
  double gap = 0.05;        ///< mm of air below it
  double axis = 0.0;        ///< rad in [0, pi): pass axis (retarder: fast axis, bef: grooves) from +x towards +y; 0
                            ///< where the kind has none
  double axis_index = 1.5;  ///< refractive index that pass_axis.h counts the axis of an oblique ray with
  std::unique_ptr<const Bsdf> surface;  ///< in the plate's frame, its axis applied; null for a sheet
  std::optional<DielectricSheet> sheet;
  /// The film at another wavelength (nm); empty: `surface` or `sheet` at every wavelength. Those hold for 550 nm.
  std::function<FilmOptics(double)> at_wavelength;
  std::vector<std::string> remarks;  ///< what its data needed, one sentence each, for the user
};

}  // namespace evenglow::tracer
