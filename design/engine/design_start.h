#pragma once

#include "design/problem/design_spec.h"
#include "tracer/scene/backlight_spec.h"
#include "tracer/scene/density_field.h"

namespace evenglow::design {

/// The density that a design begins with, on the cells of the microstructure: what the run file says (`flat`), that of
/// the streams of guided light (`analytic`, four_stream.h; its mean is the level of the spec, else that of the run
/// file), or a map of other cells (a file, an earlier result).
///
/// The streams know the plate's size and thickness, the LEDs at its edges, whether an edge has a reflector, and the
/// target; not the films or the shape of the microstructure. Their rate is that of light at a mean elevation whose
/// tangent is 0.45: 0.225 / thickness; what meets the pattern leaves with the share 1 / n^2 of a Lambertian reflector
/// in the plate, n = 1.49.
tracer::DensityField first_density(const tracer::BacklightSpec& backlight, const DesignSpec& spec);

}  // namespace evenglow::design
