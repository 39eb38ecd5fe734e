#include "bench/bench_scene.h"

#include <utility>

#include <fmt/format.h>

#include "core/config/config_node.h"

namespace evenglow::bench {
namespace {

constexpr const char* kSlab = R"(
light_guide_plate: {length_mm: 100, width_mm: 60, thickness_mm: 3, material: pmma}
microstructure: {face: bottom, cells: [100, 60], kind: printed_dot, reflectance: 0.95}
sources:
  - {kind: lambertian_face, face: left, flux_lm: 100}
reflectors:
  bottom: {kind: white, reflectance: 0.98}
  left: {kind: mirror, reflectance: 0.98}
  right: {kind: mirror, reflectance: 0.98}
  front: {kind: mirror, reflectance: 0.98}
  back: {kind: mirror, reflectance: 0.98}
)";

constexpr const char* kFilms = R"(
films:
  - {kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}
  - {kind: dbef, table: dbef.csv, hemispherical: dbef_hemispherical.csv, axis_deg: 0}
)";

constexpr const char* kIdealFilms = R"(
films:
  - {kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}
  - {kind: dbef, axis_deg: 0}
)";

constexpr const char* kPrismFilms = R"(
films:
  - {kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}
  - {kind: bef, axis_deg: 0}
  - {kind: bef, axis_deg: 90}
  - {kind: dbef, table: dbef.csv, hemispherical: dbef_hemispherical.csv, axis_deg: 0}
)";

constexpr const char* kSamples = R"(
size: {length_mm: 10, width_mm: 10}
sources: [{kind: lambertian_face, face: bottom}]
films:
  - {kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}
  - {kind: dbef, table: dbef.csv, hemispherical: dbef_hemispherical.csv}
  - {kind: dbef}
  - {kind: lpp}
)";

tracer::BacklightSpec read(const std::string& yaml) {
  const auto document =
      core::ConfigDocument::parse(yaml, std::string(EVENGLOW_SOURCE_DIR) + "/configs/data/bench.yaml");
  tracer::BacklightSpec spec = tracer::read_backlight(document.root());
  document.finish();
  return spec;
}

BenchScene compiled(const std::string& yaml) {
  tracer::BacklightSpec spec = read(yaml);
  tracer::DensityField density = tracer::initial_density(spec);
  core::CellField& cells = density.cells;
  for (int iy = 0; iy < cells.grid.ny; ++iy) {
    for (int ix = 0; ix < cells.grid.nx; ++ix) {
      cells.values[static_cast<std::size_t>(iy * cells.grid.nx + ix)] = 0.04 + 0.36 * (ix + 0.5) / cells.grid.nx;
    }
  }
  return {tracer::compile_scene(std::move(spec)), std::move(density)};
}

std::string luminance_receiver(const std::string& estimator) {
  return "receivers: [{kind: luminance, cells: [96, 48], cone_deg: 10, estimator: " + estimator + "}]\n";
}

}  // namespace

BenchScene bare_slab_scene() {
  return compiled(
      "light_guide_plate: {length_mm: 100, width_mm: 60, thickness_mm: 3, refractive_index: 1.4938}\n"
      "sources: [{kind: lambertian_face, face: left}]\n");
}

BenchScene scene_with(const SceneOptions& options) {
  static const char* const kStack[] = {
      "  - {kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}\n",
      "  - {kind: bef, axis_deg: 0}\n", "  - {kind: bef, axis_deg: 90}\n", "  - {kind: dbef, axis_deg: 0}\n"};
  std::string yaml = kSlab;
  const auto replace = [&yaml](const std::string& from, const std::string& to) {
    yaml.replace(yaml.find(from), from.size(), to);
  };
  replace("thickness_mm: 3", fmt::format("thickness_mm: {}", options.thickness));
  replace("cells: [100, 60]", fmt::format("cells: [{}, {}]", options.nx, options.ny));
  if (options.films > 0) yaml += "films:\n";
  for (int i = 0; i < options.films; ++i) yaml += kStack[i];
  BenchScene bench = compiled(yaml + luminance_receiver("counting"));
  for (double& density : bench.density.cells.values) density *= options.density;
  return bench;
}

BenchScene slab_scene(const std::string& estimator) {
  return compiled(std::string(kSlab) + luminance_receiver(estimator));
}

BenchScene film_scene(const std::string& estimator) {
  return compiled(std::string(kSlab) + kFilms + luminance_receiver(estimator));
}

BenchScene ideal_film_scene(const std::string& estimator) {
  return compiled(std::string(kSlab) + kIdealFilms + luminance_receiver(estimator));
}

BenchScene prism_scene(const std::string& estimator) {
  return compiled(std::string(kSlab) + kPrismFilms + luminance_receiver(estimator));
}

tracer::BacklightSpec film_samples() {
  return read(kSamples);
}

}  // namespace evenglow::bench
