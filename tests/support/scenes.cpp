#include "tests/support/scenes.h"

#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/config/config_node.h"
#include "tracer/scene/backlight_spec.h"

namespace evenglow::tests {

const char* const kMirrorRoom =
    "size: {length_mm: 2000, width_mm: 1000}, reflectors: {"
    "left: {kind: mirror, reflectance: 1, gap_mm: 0.001}, right: {kind: mirror, reflectance: 1, gap_mm: 0.001}, "
    "front: {kind: mirror, reflectance: 1, gap_mm: 0.001}, back: {kind: mirror, reflectance: 1, gap_mm: 0.001}";

tracer::BacklightSpec backlight_of(const std::string& flow_yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("backlight: {" + flow_yaml + "}\n", "test.yaml");
  tracer::BacklightSpec spec = tracer::read_backlight(document.root().map("backlight", "the backlight"));
  document.finish();
  return spec;
}

tracer::Scene scene_of(const std::string& flow_yaml) {
  return tracer::compile_scene(backlight_of(flow_yaml));
}

std::string text_of(double number) {
  return fmt::format("{}", number);
}

namespace {

tracer::TraceResult run(const tracer::Scene& scene, const tracer::DensityField& density, const TraceSetup& setup) {
  tracer::TraceOptions options;
  options.photons = tracer::whole_batches(setup.photons, setup.batches);
  options.batches = setup.batches;
  options.key.seed = setup.seed;
  options.threads = setup.threads;
  options.path = setup.path;
  auto result = tracer::trace(scene, density, options);
  core::expects(result.has_value(), "nobody stops the trace of a test");
  return std::move(*result);
}

}  // namespace

Traced::Traced(const std::string& flow_yaml, const TraceSetup& setup)
    : scene_(scene_of(flow_yaml)), density_(initial_density(scene_.spec)), result_(run(scene_, density_, setup)) {}

double Traced::escaped(tracer::Side side) const {
  return result_.energy.total(static_cast<std::size_t>(side)).value;
}

double Traced::absorbed(const std::string& part) const {
  double sum = 0.0;
  const auto& parts = scene_.energy.parts();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].rfind(part, 0) == 0)
      sum += result_.energy.total(scene_.energy.absorbed_bin(static_cast<int>(i))).value;
  }
  return sum;
}

double Traced::lost() const {
  double sum = 0.0;
  for (int i = 0; i < tracer::kLossReasons; ++i) {
    sum += result_.energy.total(scene_.energy.lost_bin(static_cast<tracer::LossReason>(i))).value;
  }
  return sum;
}

double Traced::accounted() const {
  double sum = 0.0;
  for (const core::Estimate& total : result_.energy.totals()) sum += total.value;
  return sum;
}

core::Estimate Traced::mean_luminance() const {
  const double cells = static_cast<double>(scene_.luminance.bins());
  const double unit = luminance_per_score(scene_.luminance, result_.flux, result_.photons) / cells;
  const core::Estimate total = result_.luminance.weighted_total(std::vector<double>(scene_.luminance.bins(), 1.0));
  return {unit * total.value, unit * total.se};
}

tracer::LuminanceMap Traced::map() const {
  return make_luminance_map(scene_.luminance, result_.luminance, result_.flux, result_.photons);
}

}  // namespace evenglow::tests
