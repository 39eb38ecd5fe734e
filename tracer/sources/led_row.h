#pragma once

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// A row of LEDs along an edge of the plate, centered on it and on its thickness.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | edge | left, right, front or back | left |
/// | count | number of LEDs | 12 |
/// | pitch_mm | distance from LED to LED | edge / count |
/// | size_mm | emitting window: along the edge, in thickness | [2.6, 0.4] |
/// | gap_mm | air between window and plate | 0.05 |
/// | flux_lm | luminous flux of each LED | that of a pattern_file in cd, else 9 |
/// | pattern, exponent, half_angle_deg, pattern_file, pattern_turn_deg | pattern_keys.h | lambertian |
/// | fluxes_lm, flux_spread, position_spread_mm, tolerance_seed, off | led_tolerances.h | all alike, all on |
/// | flux_factors, offsets_mm, height_offsets_mm | of each LED, led_tolerances.h | none |
/// | reflectance | of the window (phosphor and package) for light that comes back, Lambertian | 0.5 |
SourceSpec make_led_row(const core::ConfigNode& node);

}  // namespace evenglow::tracer
