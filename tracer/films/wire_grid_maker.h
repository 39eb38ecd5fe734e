#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// `kind: wire_grid`: reflective polarizer of fine wires (wire_grid.h).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | axis_deg | pass axis, across the wires, in [0, 180) from +x towards +y | 0 |
/// | transmittance_pass, reflectance_pass | along the pass axis, sum at most 1; the rest is absorbed | 0.88, 0.04 |
/// | extinction | transmittance_pass over the transmittance along the wires, [1, 1e12] | 1000 |
/// | reflectance_block | of light along the wires | 0.9 |
Film make_wire_grid(const core::ConfigNode& node);

}  // namespace evenglow::tracer
