#pragma once

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// Natural light, uniform over a whole face of the backlight and Lambertian (or with another pattern), in air; light
/// passes through it unhindered.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | face | left, right, front, back, bottom or top: the face that is lit | left |
/// | gap_mm | air between source and face | 0 |
/// | flux_lm | luminous flux | that of a pattern_file in cd, else 100 |
/// | pattern, exponent, half_angle_deg, pattern_file, pattern_turn_deg | pattern_keys.h | lambertian |
SourceSpec make_lambertian_face(const core::ConfigNode& node);

}  // namespace evenglow::tracer
