#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// Reads the keys of `kind: bef` and makes the film. Faults are noted at the node.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | apex_deg | angle between the facets, [20, 170] | 90 |
/// | pitch_um | width of a prism | 50 |
/// | base_um | from the flat face to the valleys | 125 |
/// | tip_flat_um, tip_radius_um | width of a flat tip, or radius of a round one | 0: sharp |
/// | refractive_index | [1.0001, 4] | 1.58 |
/// | material | instead of an index, with the material's loss; the film then depends on the wavelength | none |
/// | absorption_per_m | bulk | 0, or that of the material |
/// | axis_deg | direction of the grooves in [0, 180) from +x towards +y; 0: along x | 0 |
/// | inverted | true: the prisms face the plate (turning film) | false |
/// | gap_mm | air below the film | 0.05 |
Film make_bef(const core::ConfigNode& node);

}  // namespace evenglow::tracer
