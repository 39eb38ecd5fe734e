#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/printed_dot.h"

namespace evenglow::tracer {

const core::Registry<Microstructure>& microstructure_registry() {
  static const core::Registry<Microstructure> registry({
      {"printed_dot", "dot of white ink on the face, Lambertian and depolarizing", make_printed_dot},
  });
  return registry;
}

}  // namespace evenglow::tracer
