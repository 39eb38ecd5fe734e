#include "tracer/microstructure/printed_dot.h"

#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tracer {

Microstructure make_printed_dot(const core::ConfigNode& node) {
  const double reflectance =
      node.number({"reflectance", "reflectance of the white ink", core::Range::closed(0, 1), 0.95});
  return {"printed_dot", [reflectance](double) { return std::make_unique<OpaqueReflector>(reflectance, 0.0); }};
}

}  // namespace evenglow::tracer
