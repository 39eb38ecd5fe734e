#include "tracer/films/reflector.h"

#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tracer {

Reflector make_reflector(const core::ConfigNode& node) {
  using core::Range;
  const std::string kind =
      node.choice({"kind",
                   "white: Lambertian, depolarizes; mirror: specular, keeps polarization; mixed: both",
                   {"white", "mirror", "mixed"},
                   "white"});
  const double reflectance =
      node.number({"reflectance", "share of the light that is reflected, any angle and polarization",
                   Range::closed(0, 1), kind == "mirror" ? 0.98 : 0.96});
  double specular = kind == "mirror" ? 1.0 : 0.0;
  if (kind == "mixed") {
    specular =
        node.number({"specular_share", "share of the reflected light that is mirrored and keeps its polarization",
                     Range::closed(0, 1), 0.5});
  }
  const double gap =
      node.number({"gap_mm", "air between the plate and the reflector", {0.001, 100.0, false, false}, 0.05});
  return {gap, std::make_unique<OpaqueReflector>(reflectance, specular)};
}

}  // namespace evenglow::tracer
