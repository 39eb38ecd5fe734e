#include "tracer/transport/planar_layers.h"

#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {

/// Rooms follow one another from the one of the plate upwards.
PlanarLayers::PlanarLayers(const Scene& scene, const PlanarScene& layout, const PlanarPlate& plate, std::size_t band) {
  const SceneOptics& optics = scene.optics[band];
  const auto& rooms = layout.rooms();
  const PlanarRoom& first = rooms.front();
  const auto lower = static_cast<std::size_t>(Side::kBottom), upper = static_cast<std::size_t>(Side::kTop);
  const bool passable = !layout.has_free_source(Side::kBottom) && !layout.has_free_source(Side::kTop);
  if (first.quads[lower] >= 0) {
    add(optics, first.quads[lower], first.box.min.z());
    if (passable) set_air(plate.box);
  }
  for (const std::size_t side : {lower, upper}) {
    faces_[side - lower] = layers_.size();
    add(optics, plate.quads[side], plate.planes[side]);
    layers_.back().kind = PlanarLayer::Kind::kPlate;
  }
  layers_.back().last = plate.open_above;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const int quad = rooms[i].quads[upper];
    if (quad < 0) break;
    // Beside the plate a source may stand free.
    if (rooms[i].body < 0 && (i > 0 || passable)) set_air(i == 0 ? plate.box : rooms[i].box);
    add(optics, quad, rooms[i].box.max.z());
    layers_.back().last = layout.is_last(quad);
  }
}

void PlanarLayers::add(const SceneOptics& optics, int quad, double z) {
  using Kind = PlanarLayer::Kind;
  const Surface& surface = optics.surfaces[static_cast<std::size_t>(quad)];
  PlanarLayer layer;
  layer.quad = quad;
  layer.z = z;
  layer.optics = surface.optics;
  layer.part = surface.part;
  if (surface.windows.empty() && surface.pattern == nullptr && surface.body < 0) {
    layer.reflector = PlainReflector::of(surface.optics, surface.part);
    layer.diffuser = dynamic_cast<const Diffuser*>(surface.optics);
    layer.prism = PlanarPrism::of(surface.optics);
    // A film is turned by its axis, not by its surface.
    const bool upright = is_upright(surface);
    layer.kind = layer.reflector.known                  ? Kind::kReflector
                 : layer.diffuser != nullptr && upright ? Kind::kDiffuser
                 : layer.prism.has_value() && upright   ? Kind::kPrism
                                                        : Kind::kOther;
  }
  layers_.push_back(layer);
}

void PlanarLayers::set_air(const Box& box) {
  PlanarLayer& layer = layers_.back();
  layer.air_above = true;
  layer.min_x = box.min.x();
  layer.max_x = box.max.x();
  layer.min_y = box.min.y();
  layer.max_y = box.max.y();
}

}  // namespace evenglow::tracer
