#include "design/engine/design_start.h"

#include <algorithm>

#include "design/engine/four_stream.h"
#include "design/problem/density_limits.h"
#include "design/problem/regrid.h"
#include "design/problem/target.h"
#include "tracer/scene/scene.h"

namespace evenglow::design {
namespace {

constexpr double kMeanTangent = 0.45;  // of the elevation of guided light
constexpr double kOutShare = 0.45;     // 1 / 1.49^2
constexpr double kSheet = 0.9;         // reflectance of an edge with a reflector
constexpr double kBare = 0.04;         // and of one without
constexpr int kMostCells = 96;         // along each side: finer streams tell nothing more

core::CellGrid coarse(const core::CellGrid& cells) {
  return core::CellGrid::over(std::min(cells.nx, kMostCells), std::min(cells.ny, kMostCells), cells.x0, cells.y0,
                              cells.x0 + cells.nx * cells.dx, cells.y0 + cells.ny * cells.dy);
}

/// Length that [a, b] and [c, d] share.
double overlap(double a, double b, double c, double d) {
  return std::max(0.0, std::min(b, d) - std::max(a, c));
}

/// Flux of a source along its edge, cell by cell.
void add_inflow(const tracer::Source& source, double origin, double size, std::vector<double>& inflow) {
  const auto windows = source.windows();
  double whole = 0.0;
  for (const auto& window : windows) whole += window.max_along - window.min_along;
  for (std::size_t i = 0; i < inflow.size(); ++i) {
    if (whole <= 0.0) {
      inflow[i] += source.flux() / static_cast<double>(inflow.size());
      continue;
    }
    const double low = origin + static_cast<double>(i) * size;
    for (const auto& window : windows)
      inflow[i] += source.flux() * overlap(low, low + size, window.min_along, window.max_along) / whole;
  }
}

StreamPlate stream_plate(const tracer::BacklightSpec& backlight, const core::CellGrid& cells) {
  StreamPlate plate;
  plate.cells = cells;
  plate.out = kOutShare;
  const tracer::LightGuidePlateSpec& guide = *backlight.plate;
  for (int ix = 0; ix < cells.nx; ++ix) {
    const double along = (cells.center_x(ix) - backlight.area.min.x()) / guide.length;
    const double thickness = guide.thickness + along * (guide.end_thickness - guide.thickness);
    plate.rate.push_back(0.5 * kMeanTangent / thickness);
  }
  for (std::size_t side = 0; side < 4; ++side) {
    plate.edges[side].inflow.assign(static_cast<std::size_t>(side < 2 ? cells.ny : cells.nx), 0.0);
    plate.edges[side].reflectance = backlight.reflectors[side] ? kSheet : kBare;
  }
  for (const auto& source : backlight.sources) {
    const auto side = static_cast<std::size_t>(source->side());
    if (side >= 4) {
      plate.inside += source->flux() / static_cast<double>(cells.size());
    } else {
      add_inflow(*source, side < 2 ? cells.y0 : cells.x0, side < 2 ? cells.dy : cells.dx, plate.edges[side].inflow);
    }
  }
  return plate;
}

/// The target over the plate; beyond the display the nearest of it.
core::CellField target_over(const tracer::BacklightSpec& backlight, const DesignSpec& spec,
                            const core::CellGrid& cells) {
  core::CellField target = regrid(target_shape(spec.target, backlight.luminance.cells), cells);
  const double least = 1e-3 * target.max();
  for (double& value : target.values) value = std::max(value, least);
  return target;
}

}  // namespace

tracer::DensityField first_density(const tracer::BacklightSpec& backlight, const DesignSpec& spec) {
  tracer::DensityField density = tracer::initial_density(backlight);
  const core::CellGrid grid = density.cells.grid;
  if (spec.start.kind == "map") {
    density.cells = spec.start.map.over(grid);
  } else if (spec.start.kind == "analytic" && backlight.plate) {
    const core::CellGrid cells = coarse(grid);
    const double level = spec.level.value_or(density.cells.mean());
    density.cells = regrid(stream_density(stream_plate(backlight, cells), target_over(backlight, spec, cells), level,
                                          spec.density_min, spec.density_max),
                           grid);
  }
  return within(cell_limits(spec, grid), std::move(density));
}

}  // namespace evenglow::design
