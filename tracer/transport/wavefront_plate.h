#pragma once

#include <string>

#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/planar_plate.h"
#include "tracer/transport/planar_scene.h"
#include "tracer/wavefront/plate_constants.h"

namespace evenglow::tracer {

/// Can the wavefront trace this scene? It needs a stack of parallel layers over a plate with smooth bottom and top and
/// a clear bulk, one wavelength, and luminance that is counted. If not, `reason` says why.
bool wavefront_serves(const Scene& scene, std::string* reason = nullptr);

/// The plate as the vector kernel sees it.
PlateConstants plate_constants(const Scene& scene, const PlanarScene& layout, const PlanarPlate& plate,
                               const DensityField& density);

}  // namespace evenglow::tracer
