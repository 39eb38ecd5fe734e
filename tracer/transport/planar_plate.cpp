#include "tracer/transport/planar_plate.h"

#include <cmath>

#include "tracer/optics/dielectric_face.h"
#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tracer {
namespace {

WallBacking backing_of(const Scene& scene, const PlanarScene& layout, const SceneOptics& optics, Side side) {
  const int quad = layout.wall(side);
  if (quad < 0 || layout.has_free_source(side)) return {};
  const Surface& surface = optics.surfaces[static_cast<std::size_t>(quad)];
  if (!surface.windows.empty()) return {};
  const int axis = axis_of(side);
  const double gap =
      std::abs(scene.caster->quads()[static_cast<std::size_t>(quad)].corner[axis] - layout.plate()->box.plane(side));
  return {PlainReflector::of(surface.optics, surface.part), gap, quad};
}

}  // namespace

PlainReflector PlainReflector::of(const Bsdf* optics, int part) {
  const auto* plain = dynamic_cast<const OpaqueReflector*>(optics);
  if (plain == nullptr) return {};
  const double mirrored = plain->reflectance() * plain->specular_share();
  const auto inverse = [](double share) { return share > 0.0 ? 1.0 / share : 0.0; };
  return {true, plain->reflectance(), mirrored, part, inverse(mirrored), inverse(plain->reflectance() - mirrored)};
}

std::optional<PlanarPlate> PlanarPlate::of(const Scene& scene, const PlanarScene& layout, std::size_t band) {
  if (!layout.plate()) return std::nullopt;
  const SceneOptics& optics = scene.optics[band];
  const Body& body = optics.bodies[static_cast<std::size_t>(layout.plate()->body)];
  if (body.scattering || body.refractive_index < 1.0) return std::nullopt;
  PlanarPlate plate;
  plate.box = layout.plate()->box;
  plate.center = 0.5 * (plate.box.min + plate.box.max);
  plate.half = 0.5 * (plate.box.max - plate.box.min);
  plate.body = layout.plate()->body;
  plate.refractive_index = body.refractive_index;
  plate.per_index = 1.0 / body.refractive_index;
  plate.height = plate.box.max.z() - plate.box.min.z();
  plate.per_height = 1.0 / plate.height;
  plate.absorption = body.absorption;
  plate.part = body.part;
  plate.quads = layout.plate()->quads;
  plate.open_above = layout.is_open_above_plate();
  for (std::size_t side = 0; side < kSides; ++side) {
    plate.planes[side] = plate.box.plane(static_cast<Side>(side));
    const Surface& face = optics.surfaces[static_cast<std::size_t>(plate.quads[side])];
    const bool smooth = dynamic_cast<const DielectricFace*>(face.optics) != nullptr && face.windows.empty();
    if (side < 4) {
      plate.smooth[side] = smooth && face.pattern == nullptr;
      plate.backings[side] = backing_of(scene, layout, optics, static_cast<Side>(side));
    } else if (!smooth) {
      return std::nullopt;
    }
    if (face.pattern == nullptr) continue;
    if (side < 4 || plate.pattern != nullptr) return std::nullopt;
    plate.pattern = face.pattern;
    plate.dots = PlainReflector::of(face.pattern, face.pattern_part);
    plate.pattern_part = face.pattern_part;
    plate.pattern_side = static_cast<int>(side);
  }
  return plate;
}

}  // namespace evenglow::tracer
