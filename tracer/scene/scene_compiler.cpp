#include <utility>

#include "tracer/microstructure/dot_grid.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/scene/scene_builder.h"

namespace evenglow::tracer {
namespace {

SpectralBands bands_of(const BacklightSpec& spec) {
  std::vector<double> fluxes;
  fluxes.reserve(spec.sources.size());
  for (const auto& source : spec.sources) fluxes.push_back(source->flux());
  return {spec.spectra, fluxes, spec.wavelengths, spec.color};
}

LuminanceReceiver luminance_receiver(const LuminanceReceiverSpec& spec, double top) {
  if (!spec.views.empty()) return {spec.cells, spec.cone, spec.views};
  if (!spec.pupil) return {spec.cells, spec.cone, spec.polar, spec.azimuth};
  return {spec.cells,
          Pupil{{spec.pupil->x, spec.pupil->y, top + spec.pupil->distance}, 0.5 * spec.pupil->diameter, top}};
}

}  // namespace

DensityField initial_density(const BacklightSpec& spec) {
  const Box& area = spec.area;
  const auto grid = [&](int nx, int ny) {
    return core::CellGrid::over(nx, ny, area.min.x(), area.min.y(), area.max.x(), area.max.y());
  };
  if (!spec.microstructure) return {core::CellField(grid(1, 1), 0.0)};
  const MicrostructureSpec& pattern = *spec.microstructure;
  DensityField field{core::CellField(grid(pattern.nx, pattern.ny), pattern.density)};
  if (!pattern.density_map.empty()) field.cells.values = pattern.density_map;
  if (pattern.dots) {
    field.cells = pattern.dots->coverage(field.cells.grid);
    field.dots = pattern.dots;
  }
  return field;
}

Scene compile_scene(BacklightSpec spec) {
  SpectralBands bands = bands_of(spec);
  SceneBuilder first(spec, bands.wavelength(0));
  std::vector<SceneOptics> optics;
  optics.push_back(first.take_optics());
  for (std::size_t b = 1; b < bands.size(); ++b)
    optics.push_back(SceneBuilder(spec, bands.wavelength(b)).take_optics());
  double flux = 0.0;
  for (const auto& source : spec.sources) flux += source->flux();
  std::optional<AngularReceiver> angular;
  if (spec.angular) {
    angular.emplace(spec.angular->polar_count, spec.angular->azimuth_count,
                    display_spots(spec.luminance.cells, spec.angular->spots, spec.angular->spot_radius));
  }
  const LuminanceReceiver luminance = luminance_receiver(spec.luminance, first.box().max.z());
  auto caster = std::make_unique<RayCaster>(first.take_quads());
  return Scene{std::move(spec),
               first.box(),
               std::move(caster),
               std::move(bands),
               std::move(optics),
               first.take_source_placements(),
               flux,
               luminance,
               FluxReceiver(first.take_parts()),
               angular};
}

}  // namespace evenglow::tracer
