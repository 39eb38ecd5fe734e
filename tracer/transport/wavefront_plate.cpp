#include "tracer/transport/wavefront_plate.h"

#include <cmath>

#include "tracer/transport/photon_history.h"

namespace evenglow::tracer {
namespace {

FlatReflector flat(const PlainReflector& reflector, double gap) {
  if (!reflector.known) return {};
  return {1.0, reflector.reflectance, reflector.mirrored, static_cast<double>(reflector.part), gap};
}

/// The sheet below the plate, if nothing but air lies between.
FlatReflector sheet_below(const Scene& scene, const PlanarScene& layout) {
  const int quad = layout.wall(Side::kBottom);
  if (quad < 0 || layout.has_free_source(Side::kBottom)) return {};
  const Surface& surface = scene.optics.front().surfaces[static_cast<std::size_t>(quad)];
  if (!surface.windows.empty() || surface.pattern != nullptr) return {};
  const double z = scene.caster->quads()[static_cast<std::size_t>(quad)].corner.z();
  return flat(PlainReflector::of(surface.optics, surface.part), layout.plate()->box.min.z() - z);
}

std::string why_not(const Scene& scene) {
  std::string reason;
  const auto layout = PlanarScene::of(scene, &reason);
  if (!layout) return reason;
  if (!layout->plate()) return "it has no plate";
  if (scene.optics.size() > 1) return "its light has several wavelengths";
  if (scene.spec.microstructure && scene.spec.microstructure->dots)
    return "its pattern is traced dot by dot (backlight.microstructure.dots_file)";
  if (!PlanarPlate::of(scene, *layout, 0)) return "the plate scatters in its bulk, or its faces are no smooth planes";
  if (scene.spec.luminance.estimator == LuminanceEstimator::kNextEvent) {
    return "its luminance is not counted (receivers: estimator)";
  }
  return {};
}

}  // namespace

bool wavefront_serves(const Scene& scene, std::string* reason) {
  const std::string why = why_not(scene);
  if (reason != nullptr) *reason = why;
  return why.empty();
}

PlateConstants plate_constants(const Scene& scene, const PlanarScene& layout, const PlanarPlate& plate,
                               const DensityField& density) {
  PlateConstants to;
  to.min_x = plate.box.min.x();
  to.max_x = plate.box.max.x();
  to.min_y = plate.box.min.y();
  to.max_y = plate.box.max.y();
  to.min_z = plate.box.min.z();
  to.max_z = plate.box.max.z();
  to.index = plate.refractive_index;
  to.per_index = plate.per_index;
  to.height = plate.height;
  to.per_height = plate.per_height;
  to.absorption = plate.absorption;
  to.per_absorption = plate.absorption > 0.0 ? 1.0 / plate.absorption : 1e30;
  to.part = plate.part;
  to.open_above = plate.open_above;
  to.most_events = PhotonHistory::kMaxEvents;
  to.pattern_side = plate.pattern_side;
  to.dots = flat(plate.dots, 0.0);
  to.below = sheet_below(scene, layout);
  for (std::size_t side = 0; side < 4; ++side) {
    const WallBacking& backing = plate.backings[side];
    const FlatReflector behind = flat(backing.reflector, backing.gap);
    to.smooth[side] = plate.smooth[side] ? 1.0 : 0.0;
    to.all_smooth = to.all_smooth && plate.smooth[side];
    to.backing_known[side] = behind.known;
    to.backing_reflectance[side] = behind.reflectance;
    to.backing_mirrored[side] = behind.mirrored;
    to.backing_part[side] = behind.part;
    to.backing_gap[side] = behind.gap;
  }
  const core::CellGrid& grid = density.cells.grid;
  to.x0 = grid.x0;
  to.y0 = grid.y0;
  to.per_x = 1.0 / grid.dx;
  to.per_y = 1.0 / grid.dy;
  to.nx = grid.nx;
  to.ny = grid.ny;
  to.open.clear();
  for (const double share : density.cells.values) to.open.push_back(static_cast<float>(1.0 - share));
  return to;
}

}  // namespace evenglow::tracer
