#pragma once

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// Natural light, uniform and Lambertian over a whole face of the backlight, in air; light passes through it
/// unhindered.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | face | left, right, front, back, bottom or top: the face that is lit | left |
/// | gap_mm | air between source and face | 0 |
/// | flux_lm | luminous flux | 100 |
SourceSpec make_lambertian_face(const core::ConfigNode& node);

}  // namespace evenglow::tracer
