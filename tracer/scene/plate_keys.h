#pragma once

#include "core/config/config_node.h"
#include "tracer/scene/backlight_spec.h"

namespace evenglow::tracer {

/// Reads the map `light_guide_plate`.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | length_mm, width_mm | along x, away from the left edge, and along y | 140, 66 |
/// | thickness_mm | at the left edge | 0.6 |
/// | end_thickness_mm | at the right edge: a wedge whose bottom rises, at most thickness_mm | thickness_mm |
/// | material, ... | material_keys.h | pmma |
/// | entrance.edges | edges whose end face is serrated, of left, right, front, back | [left] |
/// | entrance.flank_deg | of the serrations: straight prisms that run through the thickness, between flank and face |
/// 30 | | entrance.fill | share of the face under serrations, 0.01 to 1 | 1 | | entrance.form | sunk or raised | sunk |
LightGuidePlateSpec read_plate(const core::ConfigNode& node);

}  // namespace evenglow::tracer
