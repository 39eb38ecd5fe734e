#include "tracer/scene/density_field.h"

#include <algorithm>

namespace evenglow::tracer {

DensityField clamped(DensityField field, double min, double max) {
  for (double& density : field.cells.values) density = std::clamp(density, min, max);
  return field;
}

}  // namespace evenglow::tracer
