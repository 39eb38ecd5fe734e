#pragma once

#include <memory>

#include "core/config/config_node.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A sheet behind or beside the plate.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | kind | `white`: Lambertian, depolarizes; `mirror`: specular, keeps polarization; `mixed` | white |
/// | reflectance | share of the light that comes back, any angle and polarization | 0.96 white, 0.98 mirror |
/// | specular_share | `mixed` only: share of the reflected light that is mirrored | 0.5 |
/// | gap_mm | air between plate and sheet | 0.05 |
struct Reflector {
  double gap = 0.0;  ///< mm
  std::unique_ptr<const Bsdf> surface;
};

/// Reads the keys above.
Reflector make_reflector(const core::ConfigNode& node);

}  // namespace evenglow::tracer
