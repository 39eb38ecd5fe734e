#pragma once

#include "core/config/config_node.h"
#include "tracer/microstructure/microstructure.h"

namespace evenglow::tracer {

/// Dot of white ink in optical contact with the face: light that meets it, from inside the plate or from outside, is
/// scattered back Lambertian and unpolarized. The chance of a hit is the local area coverage (Lee et al., Opt. Eng. 44,
/// 014004, 2005).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | reflectance | of the ink, 0 to 1 | 0.95 |
Microstructure make_printed_dot(const core::ConfigNode& node);

}  // namespace evenglow::tracer
