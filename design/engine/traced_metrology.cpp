#include "design/engine/traced_metrology.h"

#include "design/problem/color_merit.h"
#include "design/problem/hot_spots.h"

namespace evenglow::design {

std::optional<ColorJudgment> traced_color(const tracer::Scene& scene, const Observation& observation) {
  if (observation.color_x.bins() == 0) return std::nullopt;
  return judge_color(scene.luminance.cells(), {observation.color_x, observation.luminance, observation.color_z},
                     scene.bands.mean_weight());
}

std::vector<HotSpots> traced_hot_spots(const tracer::Scene& scene, const Observation& observation) {
  std::vector<HotSpots> result;
  for (std::size_t i = 0; i < scene.spec.sources.size(); ++i) {
    if (scene.spec.source_kinds[i] != "led_row") continue;
    const auto& source = *scene.spec.sources[i];
    LedEdge edge{i, side_name(source.side()), axis_of(source.side()) == 0, scene.spec.area.plane(source.side()), {}};
    for (const auto& window : source.windows()) edge.windows.push_back({window.min_along, window.max_along});
    auto spots = hot_spots(edge, scene.luminance.cells(), observation.luminance, observation.luminance_unit);
    if (spots) result.push_back(std::move(*spots));
  }
  return result;
}

}  // namespace evenglow::design
