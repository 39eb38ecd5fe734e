#include "tracer/scene/density_field.h"

#include <algorithm>

#include "tracer/microstructure/dot_grid.h"

namespace evenglow::tracer {

double DensityField::dots_at(double x, double y) const {
  return dots->covers(x, y) ? 1.0 : 0.0;
}

DensityField clamped(DensityField field, double min, double max) {
  for (double& density : field.cells.values) density = std::clamp(density, min, max);
  return field;
}

}  // namespace evenglow::tracer
