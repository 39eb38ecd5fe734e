#pragma once

#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/lobe_model.h"

namespace evenglow::tracer {

/// The model at every incidence of the grid that `SampledBsdf` works on, so that nothing is interpolated between
/// incidences: psi every 15 degrees, sigma up to 89.5 degrees, phi every 15 degrees, theta closer where the lobes are.
/// Beyond the horizon ln S goes on along the line from the last node above it through the horizon. `n` of the pass axis
/// (delta) is the model's refractive index; a `TabulatedDbef` counts with 1.58. One wavelength, 550 nm.
BsdfTable lobe_table(const LobeModel& model);

/// The model's totals at every degree of incidence.
HemisphericalTable lobe_hemispherical(const LobeModel& model);

}  // namespace evenglow::tracer
