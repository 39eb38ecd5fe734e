#include "tracer/microstructure/cone.h"
#include "tracer/microstructure/microlens.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/printed_dot.h"
#include "tracer/microstructure/pyramid.h"
#include "tracer/microstructure/v_groove.h"

namespace evenglow::tracer {

const core::Registry<Microstructure>& microstructure_registry() {
  static const core::Registry<Microstructure> registry({
      {"printed_dot", "dot of white ink on the face, Lambertian and depolarizing", make_printed_dot},
      {"microlens", "cap of a sphere, raised or sunk", make_microlens},
      {"cone", "cone, pointed or truncated, raised or sunk", make_cone},
      {"pyramid", "pyramid on a square, pointed or truncated, raised or sunk", make_pyramid},
      {"v_groove", "straight groove of two flanks, or a prism, with an axis", make_v_groove},
  });
  return registry;
}

}  // namespace evenglow::tracer
