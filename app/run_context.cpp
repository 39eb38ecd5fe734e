#include "app/run_context.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "core/base/build_id.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/version.h"
#include "core/parallel/ranks.h"
#include "design/engine/design_start.h"
#include "design/engine/traced_model.h"

namespace evenglow::app {

std::string run_identity(const Run& run, std::string_view command, std::uint32_t stream) {
  std::string text =
      fmt::format("{}\n{}\n{}\n{}\n{}", core::version(), core::build_id(), command, stream, run.file_text);
  for (const std::string& change : run.overrides) text += '\n' + change;
  for (const auto& file : run.data_files) text += '\n' + core::sha256_hex_of_file(file);
  return core::sha256_hex(text);
}

void agree_on_input(const Options& options, const std::string& identity, const std::stop_token& stop) {
  if (options.ranks == nullptr) return;
  const std::vector<std::string> all = options.ranks->texts(identity, stop);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i] == all[0]) continue;
    throw core::ConfigError(core::Fault{fmt::format("rank {}", i), 0, 0, "",
                                        "must be given the input of rank 0 (program, command, options, run files and "
                                        "data files with the same content), got another"});
  }
}

std::size_t disk_bytes(const Run& run) {
  constexpr std::size_t kStates = 3;         // the newest, the one before, and one that is being written
  constexpr std::size_t kStateBytes = 64;    // of a cell, seen: 46
  constexpr std::size_t kResultBytes = 500;  // of a cell, seen: 459, of all formats with color
  std::size_t cells = run.backlight.luminance.cells.size();
  if (const auto& structure = run.backlight.microstructure)
    cells = std::max(cells, static_cast<std::size_t>(structure->nx) * static_cast<std::size_t>(structure->ny));
  return (kStates * kStateBytes + kResultBytes) * cells;
}

design::StateBounds state_bounds(const Run& run) {
  return {design::first_density(run.backlight, run.design).cells.grid, run.backlight.luminance.cells,
          design_limits(run).largest_photons};
}

design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context) {
  design::TracedModelOptions options;
  options.seed = run.trace.seed;
  options.stream = context.stream;
  options.batches = run.trace.batches;
  options.threads = context.options.threads;
  options.stop = context.stop;
  options.path = run.trace.path;
  options.ranks = context.options.ranks;
  Progress& progress = context.progress;
  options.progress = [&progress](std::uint64_t done, std::uint64_t all) { progress.photons(done, all); };
  return traced_model(scene, std::move(options));
}

design::DesignLimits design_limits(const Run& run) {
  design::DesignLimits limits;
  limits.largest_photons = run.trace.photons;
  const auto cells = static_cast<std::uint64_t>(run.backlight.luminance.cells.size());
  limits.first_photons = run.design.first_photons > 0 ? run.design.first_photons : 50 * cells;
  limits.first_photons =
      std::min(tracer::whole_batches(limits.first_photons, run.trace.batches), limits.largest_photons);
  return limits;
}

std::string label(const Run& run, const std::string& text) {
  return run.variant.empty() ? text : run.variant + ": " + text;
}

void check_light(const design::StepRecord& record, const std::string& variant) {
  if (record.luminance_mean > 0.0) return;
  throw core::Error(fmt::format(
      "{}{}no light reached the display's active area in step {}: a design needs films that let it pass, and photons "
      "enough",
      variant, variant.empty() ? "" : ": ", record.step));
}

}  // namespace evenglow::app
