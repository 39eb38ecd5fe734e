// Evenglow as a library: traces a backlight and tells how bright it is.
#include <cstdio>
#include <exception>

#include "core/config/config_node.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/tracer.h"

namespace {

constexpr const char* kBacklight = R"(
backlight:
  light_guide_plate: {length_mm: 140, width_mm: 66, thickness_mm: 0.6}
  microstructure: {cells: [96, 48], density: 0.1}
  sources: [{kind: led_row, count: 12, pitch_mm: 5.4, flux_lm: 9}]
  reflectors: {bottom: {kind: white, reflectance: 0.96}}
  films: [{kind: diffuser, transmittance: 0.88, reflectance: 0.1}]
)";

void run() {
  using namespace evenglow;
  const auto document = core::ConfigDocument::parse(kBacklight, "in memory");
  tracer::BacklightSpec backlight = tracer::read_backlight(document.root().map("backlight", "the backlight", true));
  document.finish();  // throws all faults at once
  const tracer::DensityField density = tracer::initial_density(backlight);
  const tracer::Scene scene = tracer::compile_scene(std::move(backlight));
  tracer::TraceOptions options;
  options.photons = 200'000;
  const auto result = tracer::trace(scene, density, options);
  const auto top = result->energy.total(static_cast<std::size_t>(tracer::Side::kTop));
  const double photons = static_cast<double>(result->photons);
  std::printf("%.2f +- %.2f %% of the light leaves the top\n", 100.0 * top.value / photons, 100.0 * top.se / photons);
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
