#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/config/registry.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A shape of the pattern: what a photon meets with the odds of the local density.
struct Microstructure {
  std::string kind;
  /// Its optics, for light that meets the patterned area, on a plate of this refractive index, normal out of the plate.
  std::function<std::unique_ptr<const Bsdf>(double)> optics;
  /// Share of the patterned area under footprints: (area of all structures) / (area of the face) = density * fill.
  double fill = 1.0;
};

/// One line for each shape; a maker reads the shape's keys from the node `backlight.microstructure`.
const core::Registry<Microstructure>& microstructure_registry();

}  // namespace evenglow::tracer
