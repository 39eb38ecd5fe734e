#pragma once

#include "core/config/config_node.h"
#include "tracer/scene/backlight_spec.h"

namespace evenglow::tracer {

/// Reads the list `receivers` of the map `backlight` into `spec`, whose area, pattern, films and reflectors are known.
///
/// | kind | key | meaning | default |
/// | --- | --- | --- | --- |
/// | luminance | cells, margins, estimator | see docs/run_file.md | |
/// |  | cone_deg | half angle of the viewing cone | 10 |
/// |  | direction_deg | polar angle and azimuth of the cone's axis; polar + cone at most 89 unless polar is 0 | [0, 0]
/// | | angular | polar_count, azimuth_count | bins | 18, 24 | |  | at | all: over the whole area; center, 9, 13: also
/// at the spots of these points of the active area | all | |  | spot_mm | diameter of a spot, up to a fifth of the
/// shorter side | 8 % of the diagonal, at most that | | color | | of each cell of the luminance receiver | | | flux | |
/// always kept | |
void read_receivers(const core::ConfigNode& backlight, BacklightSpec& spec);

}  // namespace evenglow::tracer
