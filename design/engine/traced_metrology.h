#pragma once

#include <optional>
#include <vector>

#include "design/problem/design_state.h"
#include "design/problem/metrology.h"
#include "tracer/scene/scene.h"

namespace evenglow::design {

/// The color of the display; none unless a color receiver was asked for.
std::optional<ColorJudgment> traced_color(const tracer::Scene& scene, const Observation& observation);

/// Of each row of LEDs that has gaps in front of the display.
std::vector<HotSpots> traced_hot_spots(const tracer::Scene& scene, const Observation& observation);

}  // namespace evenglow::design
