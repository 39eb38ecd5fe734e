#include "app/run_file.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/dots_verify.h"
#include "app/output_directory.h"
#include "design/problem/target.h"
#include "design/report/writer_registry.h"
#include "tracer/transport/planar_scene.h"

namespace evenglow::app {
namespace {

using core::ConfigDocument;

void check_version(const core::ConfigNode& root) {
  const long long version = root.integer({"evenglow", "version of this format, 1", 1, 1000, {}});
  if (version == 1) return;
  root.fault_at("evenglow",
                fmt::format("must be 1, the version of the format that this program reads, got {}", version));
}

/// A text as YAML, whatever it holds.
std::string quoted_yaml(const std::string& text) {
  std::string yaml = "'";
  for (const char c : text) yaml += c == '\'' ? std::string("''") : std::string(1, c);
  return yaml + "'";
}

/// A path that the backlight does not allow is told before the first photon.
void check_path(const ConfigDocument& document, const Run& run) {
  const bool by_dots = run.backlight.microstructure && run.backlight.microstructure->dots;
  if (run.trace.path == tracer::TracePath::kWavefront && by_dots) {
    document.root()
        .map("trace", "how it is traced")
        .fault_at("path",
                  "wavefront knows densities only, not dots one by one (backlight.microstructure.dots_file); allowed "
                  "here: auto, planar, general, got wavefront");
    document.finish();
  }
  if (run.trace.path != tracer::TracePath::kPlanar) return;
  std::string reason;
  const core::ConfigNode root = document.root();
  tracer::BacklightSpec again = tracer::read_backlight(root.map("backlight", "the backlight"));  // it cannot be copied
  if (tracer::PlanarScene::of(tracer::compile_scene(std::move(again)), &reason)) return;
  root.map("trace", "how it is traced")
      .fault_at("path",
                fmt::format("planar is for parallel layers over a flat plate ({}); allowed here: auto, general, "
                            "got planar",
                            reason));
  document.finish();
}

/// Each batch of a trace holds the display's cells (three numbers with color, for each view), until all are added.
void check_memory(const core::ConfigNode& root, const Run& run) {
  constexpr std::size_t kMostNumbers = 400'000'000;  // 3.2 GB
  const tracer::BacklightSpec& backlight = run.backlight;
  const std::size_t numbers = backlight.luminance.cells.size() *
                              std::max<std::size_t>(1, backlight.luminance.views.size()) * (backlight.color ? 3 : 1);
  if (numbers == 0 || run.trace.batches <= kMostNumbers / numbers) return;
  root.map("trace", "how it is traced")
      .fault_at("batches",
                fmt::format("must be at most {} where the display has {} x {} cells (each batch holds {} numbers of "
                            "them; {} in all fit in 3.2 GB), got {}; or take fewer cells",
                            kMostNumbers / numbers, backlight.luminance.cells.nx, backlight.luminance.cells.ny, numbers,
                            kMostNumbers, run.trace.batches));
}

/// What only the whole run tells of the design.
void check_design(const core::ConfigNode& root, const Run& run) {
  const core::ConfigNode design = root.map("design", "how it is designed");
  if (run.design.goal.color && !run.backlight.color) {
    design.map("subject_to", "bounds of the design")
        .fault_at("color", "needs a receiver of kind color in backlight.receivers, got none");
  }
  const core::CellGrid& display = run.backlight.luminance.cells;
  if (!run.design.mask.empty() && display.size() > 0 &&
      design::counted_cells(run.design, design::target_shape(run.design.target, display)).empty()) {
    design.fault_at("mask", fmt::format("must leave at least one of the {} x {} cells of the display, got none",
                                        display.nx, display.ny));
  }
  const bool derived = run.design.updater == "gradient" || run.design.updater == "coarse_newton";
  if (derived && run.backlight.microstructure && run.backlight.microstructure->subcells > 1) {
    design.fault_at("updater", fmt::format("must be another one where the density is bilinear within a cell, got {}",
                                           run.design.updater));
  }
}

Run read(ConfigDocument& document, const std::vector<ConfigDocument::Override>& overrides, Purpose purpose) {
  for (const auto& change : overrides) document.apply(change);
  Run run = read_keys(document, purpose);
  for (const auto& change : overrides) run.overrides.push_back(change.path + "=" + change.yaml);
  document.finish();
  check_path(document, run);
  return run;
}

}  // namespace

Run read_keys(const ConfigDocument& document, Purpose purpose) {
  Run run;
  document.variants();  // counts as read
  document.sweep();
  const core::ConfigNode root = document.root();
  check_version(root);
  run.title = root.text({"title", "one line for the report", document.name()});
  if (!root.has("backlight")) root.fault_at("backlight", "must be given as a map of its parts, got nothing");
  const core::ConfigNode backlight = root.map("backlight", "the backlight");
  run.backlight = tracer::read_backlight(backlight);
  if (purpose == Purpose::kDesign && backlight.present() && !backlight.has("microstructure")) {
    backlight.fault_at("microstructure",
                       "must be given for a design, which changes its density, got nothing (simulate needs none)");
  }
  if (purpose == Purpose::kDesign && run.backlight.microstructure && run.backlight.microstructure->dots) {
    backlight.map("microstructure", "the pattern that throws the light out of the plate")
        .fault_at("dots_file",
                  "must be left out for a design, which changes densities, not dots (simulate traces them)");
  }
  run.trace = tracer::read_trace(root.map("trace", "how it is traced"));
  check_memory(root, run);
  run.design = design::read_design(root.map("design", "how it is designed"));
  check_design(root, run);
  run.outer = design::read_outer(root);
  const std::string shape = run.backlight.microstructure ? run.backlight.microstructure->shape.kind : "";
  run.dots =
      design::read_dots(root.map("dots", "how the density becomes real dots (evenglow dots)"),
                        shape == "pyramid" || shape == "v_groove" ? core::Footprint::square : core::Footprint::round);
  if (purpose == Purpose::kDesign) check_verify(root, run);
  run.tolerance = design::read_tolerance(root, run.backlight);
  run.output = root.choices({"output", "formats of the result files", design::output_formats(),
                             fmt::format("{}", fmt::join(design::default_output_formats(), ","))});
  if (run.output.empty()) root.fault_at("output", "must name at least one format, got none");
  run.file_text = document.source_text();
  run.data_files = document.files();
  return run;
}

std::vector<core::ConfigDocument::Override> option_overrides(const Options& options) {
  std::vector<core::ConfigDocument::Override> result;
  for (const std::string& text : options.set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw core::ConfigError(core::Fault{"--set", 0, 0, "", "must be key=value, got \"" + text + "\""});
    }
    result.push_back({text.substr(0, equals), text.substr(equals + 1), "--set"});
  }
  if (!options.design.empty()) {
    const std::string path = std::filesystem::absolute(options.design).lexically_normal().string();
    result.push_back({"tolerance.result", quoted_yaml(path), "--design"});
  }
  if (options.seed) result.push_back({"trace.seed", *options.seed, "--seed"});
  if (options.photons) result.push_back({"trace.photons", *options.photons, "--photons"});
  return result;
}

Run read_run(const std::filesystem::path& file, const Options& options, Purpose purpose) {
  return read_point(file, {}, options, purpose);
}

Run read_point(const std::filesystem::path& file, const RunPoint& point, const Options& options, Purpose purpose,
               const std::vector<ConfigDocument::Override>& last) {
  ConfigDocument document = ConfigDocument::load(file);
  std::vector<ConfigDocument::Override> overrides = point.changes;
  const auto from_options = option_overrides(options);
  overrides.insert(overrides.end(), from_options.begin(), from_options.end());
  overrides.insert(overrides.end(), last.begin(), last.end());
  Run run = read(document, overrides, purpose);
  run.file = file;
  run.variant = point.name;
  if (options.helper) run.output.clear();
  return run;
}

std::vector<RunPoint> run_points(const std::filesystem::path& file) {
  const ConfigDocument document = ConfigDocument::load(file);
  auto variants = document.variants();
  auto sweep = document.sweep();
  if (variants.empty()) variants.push_back({});
  if (sweep.empty()) sweep.push_back({});
  std::vector<RunPoint> points;
  for (const auto& [variant, variant_changes] : variants) {
    for (const auto& [place, sweep_changes] : sweep) {
      RunPoint point{fmt::format("{}{}{}", variant, variant.empty() || place.empty() ? "" : "_", place),
                     variant_changes};
      point.changes.insert(point.changes.end(), sweep_changes.begin(), sweep_changes.end());
      points.push_back(std::move(point));
    }
  }
  return points;
}

std::vector<Run> read_variants(const std::filesystem::path& file, const Options& options, Purpose purpose) {
  const auto variants = ConfigDocument::load(file).variants();
  std::vector<Run> runs;
  if (variants.empty()) {
    runs.push_back(read_run(file, options, purpose));
    return runs;
  }
  std::vector<core::Fault> faults;
  for (const auto& [name, changes] : variants) {
    if (is_result_name(name)) {
      faults.push_back(
          {file.string(), 0, 0, "variants." + name, "must not have the name of a result file, got " + name});
    }
    try {
      runs.push_back(read_point(file, {name, changes}, options, purpose));
    } catch (const core::ConfigError& error) {
      for (const core::Fault& fault : error.faults()) {
        const auto same = [&](const core::Fault& other) { return other.to_string() == fault.to_string(); };
        if (std::none_of(faults.begin(), faults.end(), same)) faults.push_back(fault);
      }
    }
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
  return runs;
}

}  // namespace evenglow::app
