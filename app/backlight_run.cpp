#include "app/backlight_run.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/config/message_text.h"
#include "core/montecarlo/batches.h"
#include "design/engine/checkpoint.h"
#include "design/engine/design_loop.h"
#include "design/engine/traced_metrology.h"
#include "design/engine/traced_model.h"
#include "design/report/number_format.h"

namespace evenglow::app {
namespace {

using design::Report;

struct Stopwatch {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpu = core::process_cpu_seconds();

  double wall_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(); }
  double cpu_s() const { return core::process_cpu_seconds() - cpu; }
};

std::string estimator_text(const tracer::LuminanceReceiverSpec& luminance) {
  std::string cone =
      fmt::format("a cone of {:.3g} degrees (half angle) about the normal", luminance.cone / core::kRadPerDeg);
  if (luminance.polar > 0.0) {
    cone = fmt::format(
        "a cone of {:.3g} degrees (half angle) about the direction of polar angle {:.4g} and azimuth "
        "{:.4g} degrees",
        luminance.cone / core::kRadPerDeg, luminance.polar / core::kRadPerDeg, luminance.azimuth / core::kRadPerDeg);
  }
  if (luminance.estimator == tracer::LuminanceEstimator::kCounting) {
    return "Mean luminance in " + cone + ", by counting the photons that leave within it.";
  }
  return "Mean luminance in " + cone +
         ", as the expected value at each scatter in the topmost scattering film (next-event estimate); light that "
         "passes "
         "that film straight is counted.";
}

Report describe_run(const Run& run, const RunContext& context) {
  Report report;
  report.version = core::version();
  report.title = run.title;
  report.variant = run.variant;
  report.command = context.command;
  report.run_file_text = run.file_text;
  report.run_file_sha256 = core::sha256_hex(run.file_text);
  report.overrides = run.overrides;
  report.seed = run.trace.seed;
  report.threads = core::effective_threads(context.options.threads);
  report.luminance_estimator = estimator_text(run.backlight.luminance);
  report.density_min = run.design.density_min;
  report.density_max = run.design.density_max;
  for (std::size_t i = 0; i < run.backlight.films.size(); ++i) {
    for (const std::string& remark : run.backlight.films[i].remarks) {
      report.notes.push_back(fmt::format("films[{}] ({}): {}", i, run.backlight.films[i].kind, remark));
    }
  }
  for (std::size_t i = 0; i < run.backlight.sources.size(); ++i) {
    const std::string note = run.backlight.sources[i]->note();
    if (!note.empty())
      report.notes.push_back(fmt::format("sources[{}] ({}): {}", i, run.backlight.source_kinds[i], note));
  }
  return report;
}

void take_observation(const tracer::Scene& scene, const design::Observation& observation, Report& report) {
  report.final = make_judgment(observation);
  report.luminance = observation.map.luminance;
  report.luminance_se = observation.map.standard_error;
  report.energy = observation.energy;
  report.angular = observation.angular;
  report.angular_spots = observation.angular_spots;
  report.color = traced_color(scene, observation);
  report.hot_spots = traced_hot_spots(scene, observation);
}

void finish_timing(const Stopwatch& watch, Report& report) {
  double photons = static_cast<double>(report.final.photons);
  double cpu = 0.0;
  for (const design::StepRecord& step : report.steps) {
    photons += static_cast<double>(step.photons);
    cpu += step.cpu_s;
  }
  report.timing.wall_s = watch.wall_s();
  report.timing.cpu_s = std::max(watch.cpu_s(), cpu);
  report.timing.photons_per_cpu_s = report.timing.cpu_s > 0.0 ? photons / report.timing.cpu_s : 0.0;
}

design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context) {
  design::TracedModelOptions options;
  options.seed = run.trace.seed;
  options.stream = context.stream;
  options.batches = run.trace.batches;
  options.threads = context.options.threads;
  options.stop = context.stop;
  Progress& progress = context.progress;
  options.progress = [&progress](std::uint64_t done, std::uint64_t all) { progress.photons(done, all); };
  return traced_model(scene, std::move(options));
}

std::string label(const Run& run, const std::string& text) {
  return run.variant.empty() ? text : run.variant + ": " + text;
}

/// Everything that the bits of a design depend on.
std::string identity(const Run& run, std::uint32_t stream) {
  std::string text = std::string(core::version()) + '\n' + std::to_string(stream) + '\n' + run.file_text;
  for (const std::string& change : run.overrides) text += '\n' + change;
  for (const auto& file : run.data_files) text += '\n' + core::sha256_hex_of_file(file);
  return core::sha256_hex(text);
}

/// The state to go on from; none if there is no checkpoint.
std::optional<design::DesignProgress> load_state(const Run& run, const RunContext& context) {
  try {
    return design::load_checkpoint(context.checkpoint, identity(run, context.stream));
  } catch (const core::Error& error) {
    throw core::ConfigError(
        core::Fault{"--resume", 0, 0, "", core::one_line(error.what()) + " (--overwrite begins anew)"});
  }
}

design::DesignProgress begin_design(const Run& run, const design::DesignLimits& limits, const RunContext& context) {
  if (context.options.resume) {
    if (auto saved = load_state(run, context)) {
      context.progress.line(label(run, fmt::format("resumed after step {}", saved->steps.back().step)));
      return std::move(*saved);
    }
  }
  return design::start_design(tracer::initial_density(run.backlight), run.design, limits);
}

}  // namespace

std::optional<Report> run_simulation(Run run, const RunContext& context) {
  const Stopwatch watch;
  Report report = describe_run(run, context);
  const tracer::DensityField density = tracer::initial_density(run.backlight);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  context.progress.begin(label(run, "tracing"));
  const auto observation = make_model(scene, run, context)(density, run.trace.photons, 0);
  if (!observation) return std::nullopt;
  report.stop_reason = "single trace";
  report.density = density.cells;
  report.steps = {make_step_record(0, density, *observation)};
  report.start_luminance = observation->map.luminance;
  take_observation(scene, *observation, report);
  finish_timing(watch, report);
  report.timing.photons_per_cpu_s = static_cast<double>(observation->photons) / std::max(observation->cpu_s, 1e-9);
  return report;
}

std::optional<Report> run_design_job(Run run, const RunContext& context) {
  const Stopwatch watch;
  Report report = describe_run(run, context);
  design::DesignLimits limits;
  limits.largest_photons = run.trace.photons;
  const auto cells = static_cast<std::uint64_t>(run.backlight.luminance.cells.size());
  limits.first_photons = run.design.first_photons > 0 ? run.design.first_photons : 50 * cells;
  limits.first_photons =
      std::min(tracer::whole_batches(limits.first_photons, run.trace.batches), limits.largest_photons);
  design::DesignProgress progress = begin_design(run, limits, context);
  const std::string run_identity = identity(run, context.stream);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  const auto observer = [&](const design::StepRecord& record, const design::DesignProgress& state) {
    context.progress.line(label(run, describe(record)));
    if (!(record.luminance_mean > 0.0)) {
      throw core::Error(label(
          run, fmt::format("no light reached the display's active area in step {}: a design needs films that let it "
                           "pass, and photons enough",
                           record.step)));
    }
    if (!context.checkpoint.empty()) save_checkpoint(context.checkpoint, run_identity, state);
    context.progress.begin(label(run, fmt::format("step {}", record.step + 1)));
  };
  context.progress.begin(label(run, "step 0"));
  progress = run_design(model, run.design, limits, std::move(progress), observer);
  if (progress.stop_reason.empty()) return std::nullopt;
  context.progress.line(label(run, progress.stop_reason));
  context.progress.begin(label(run, "final trace"));
  const auto observation = model(progress.best_density, run.trace.photons, design::kJudgingStep);
  if (!observation) return std::nullopt;
  report.stop_reason = progress.stop_reason;
  report.density = progress.best_density.cells;
  report.steps = progress.steps;
  report.start_luminance = progress.start_luminance;
  if (!progress.level_note.empty()) report.notes.push_back(progress.level_note);
  report.notes.insert(report.notes.end(), progress.limit_notes.begin(), progress.limit_notes.end());
  take_observation(scene, *observation, report);
  finish_timing(watch, report);
  return report;
}

void print_result(const Report& report, const std::filesystem::path& directory) {
  const design::FinalJudgment& f = report.final;
  fmt::print("{}{}\n", report.title, report.variant.empty() ? "" : " (" + report.variant + ")");
  fmt::print("  stop                 {}\n", report.stop_reason);
  fmt::print("  RMS non-uniformity   {:.2f} +- {:.2f} % (noise taken off; {:.2f} % with it)\n",
             100.0 * f.rms_corrected.value, 100.0 * f.rms_corrected.se, 100.0 * f.rms);
  fmt::print("  mean luminance       {:.1f} +- {:.1f} cd/m2\n", f.luminance_mean.value, f.luminance_mean.se);
  fmt::print("  efficiency           {:.2f} +- {:.2f} %\n", 100.0 * f.efficiency.value, 100.0 * f.efficiency.se);
  fmt::print("  uniformity 9 / 13    {:.3f} / {:.3f}\n", f.uniformity_9, f.uniformity_13);
  if (report.color) {
    fmt::print("  color                x {}, y {}, {} K\n", design::measured(report.color->mean.x),
               design::measured(report.color->mean.y), design::measured(report.color->mean.kelvin));
    fmt::print("  color RMS, maximum   {}, {} (delta u'v' from the mean, noise taken off)\n",
               design::measured(report.color->rms_corrected), design::measured(report.color->max_corrected));
  }
  fmt::print("  photons, time        {:.3g} in the final trace, {:.1f} s in all\n", static_cast<double>(f.photons),
             report.timing.wall_s);
  fmt::print("  files                {}\n", directory.string());
}

}  // namespace evenglow::app
