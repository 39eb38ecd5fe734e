#pragma once

#include "core/config/config_node.h"
#include "tracer/scene/backlight_spec.h"

namespace evenglow::tracer {

/// Reads the list `receivers` of the map `backlight` into `spec`, whose area, pattern, films and reflectors are known.
///
/// - `luminance`: `cells`, `margins`, `estimator`: see docs/run_file.md; `cone_deg` (10): half angle of the viewing
/// cone;
///   `direction_deg` ([0, 0]): polar angle and azimuth of its axis, polar + cone at most 89 unless polar is 0; or
///   `views: [{direction_deg, weight}]`: up to nine such axes, whose weighted sum counts;
///   `pupil: {distance_mm, diameter_mm, at: [x, y]}`, by default before the center of the active area.
/// - `angular`: `polar_count` (18), `azimuth_count` (24): bins; `at` (all): all, over the whole area; center, 9, 13:
///   also at the spots of these points of the active area; `spot_mm` (8 % of the diagonal): diameter of a spot, up to a
///   fifth of the shorter side.
/// - `color`: of each cell of the luminance receiver.
/// - `flux`: always kept.
void read_receivers(const core::ConfigNode& backlight, BacklightSpec& spec);

}  // namespace evenglow::tracer
