#include "tracer/sources/beam.h"
#include "tracer/sources/lambertian_face.h"
#include "tracer/sources/led_row.h"
#include "tracer/sources/ray_file_source.h"
#include "tracer/sources/source.h"

namespace evenglow::tracer {

const core::Registry<SourceSpec>& source_registry() {
  static const core::Registry<SourceSpec> registry({
      {"led_row", "a row of equal LEDs along an edge", make_led_row},
      {"lambertian_face", "natural light, uniform and Lambertian over a face", make_lambertian_face},
      {"beam", "a collimated beam onto the middle of a face", make_beam},
      {"ray_file", "measured or simulated rays of a file, at places along a face", make_ray_file},
  });
  return registry;
}

}  // namespace evenglow::tracer
