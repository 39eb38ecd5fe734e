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
#include "design/engine/design_start.h"
#include "design/engine/level_front.h"
#include "design/engine/traced_metrology.h"
#include "design/engine/traced_model.h"
#include "design/problem/target.h"
#include "design/report/number_format.h"
#include "design/report/processor.h"

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
  if (luminance.pupil) {
    const tracer::PupilSpec& pupil = *luminance.pupil;
    cone = fmt::format("a pupil of {:.4g} mm at a distance of {:.5g} mm before the point ({:.5g}, {:.5g}) mm",
                       pupil.diameter, pupil.distance, pupil.x, pupil.y);
  }
  if (luminance.estimator == tracer::LuminanceEstimator::kCounting) {
    return "Mean luminance in " + cone + ", by counting the photons that leave within it.";
  }
  return "Mean luminance in " + cone +
         ", as what each scatter is expected to send there through the films above (next-event estimate); light that "
         "takes other ways is counted.";
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
  report.processor = design::processor_name();
  report.luminance_estimator = estimator_text(run.backlight.luminance);
  report.density_min = run.design.density_min;
  report.density_max = run.design.density_max;
  for (std::size_t i = 0; i < run.backlight.films.size(); ++i) {
    const tracer::Film& film = run.backlight.films[i];
    report.films.push_back({film.kind, film.axis / core::kRadPerDeg, film.gap, film.remarks});
    for (const std::string& remark : film.remarks) report.notes.push_back(film_note(i, report.films.back(), remark));
  }
  for (std::size_t i = 0; i < run.backlight.sources.size(); ++i) {
    const std::string note = run.backlight.sources[i]->note();
    if (!note.empty())
      report.notes.push_back(fmt::format("sources[{}] ({}): {}", i, run.backlight.source_kinds[i], note));
  }
  return report;
}

void take_observation(const tracer::Scene& scene, const design::DesignSpec& spec,
                      const design::Observation& observation, Report& report) {
  report.final = make_judgment(observation, spec);
  report.luminance = observation.map.luminance;
  report.luminance_se = observation.map.standard_error;
  const design::Target target(spec, observation.map.luminance.grid);
  if (!target.plain()) report.target = target.relative();
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

std::string label(const Run& run, const std::string& text) {
  return run.variant.empty() ? text : run.variant + ": " + text;
}

/// The state to go on from; none if there is no checkpoint.
std::optional<design::DesignProgress> load_state(const Run& run, const RunContext& context) {
  try {
    return design::load_checkpoint(context.checkpoint, run_identity(run, context.stream));
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
  return design::start_design(design::first_density(run.backlight, run.design), run.design, limits);
}

}  // namespace

std::string run_identity(const Run& run, std::uint32_t stream) {
  std::string text = std::string(core::version()) + '\n' + std::to_string(stream) + '\n' + run.file_text;
  for (const std::string& change : run.overrides) text += '\n' + change;
  for (const auto& file : run.data_files) text += '\n' + core::sha256_hex_of_file(file);
  return core::sha256_hex(text);
}

design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context) {
  design::TracedModelOptions options;
  options.seed = run.trace.seed;
  options.stream = context.stream;
  options.batches = run.trace.batches;
  options.threads = context.options.threads;
  options.stop = context.stop;
  options.path = run.trace.path;
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
  report.steps = {make_step_record(0, density, *observation, run.design)};
  report.start_luminance = observation->map.luminance;
  take_observation(scene, run.design, *observation, report);
  finish_timing(watch, report);
  report.timing.photons_per_cpu_s = static_cast<double>(observation->photons) / std::max(observation->cpu_s, 1e-9);
  return report;
}

namespace {

/// What became of each design of a search.
struct SearchLog {
  std::vector<std::vector<design::StepRecord>> steps;
  std::vector<core::CellField> start_luminance;
};

std::string point_note(const design::FrontPoint& point) {
  return fmt::format("Level {:.4f}: RMS {:.2f} +- {:.2f} %, efficiency {:.2f} +- {:.2f} %, {} steps.", point.level,
                     100.0 * point.judged.rms_corrected.value, 100.0 * point.judged.rms_corrected.se,
                     100.0 * point.judged.efficiency.value, 100.0 * point.judged.efficiency.se, point.steps);
}

void check_light(const design::StepRecord& record, const std::string& variant) {
  if (record.luminance_mean > 0.0) return;
  throw core::Error(fmt::format(
      "{}{}no light reached the display's active area in step {}: a design needs films that let it pass, and photons "
      "enough",
      variant, variant.empty() ? "" : ": ", record.step));
}

}  // namespace

design::FrontHooks front_hooks(const Run& run, const RunContext& context, const std::string& identity) {
  design::FrontHooks hooks;
  hooks.load = [&context, identity](int point) -> std::optional<design::DesignProgress> {
    if (!context.options.resume) return std::nullopt;
    try {
      return design::load_checkpoint(point_checkpoint(context.checkpoint, point), identity);
    } catch (const core::Error& error) {
      throw core::ConfigError(
          core::Fault{"--resume", 0, 0, "", core::one_line(error.what()) + " (--overwrite begins anew)"});
    }
  };
  hooks.stepped = [&context, identity, variant = run.variant](int point, const design::StepRecord& record,
                                                              const design::DesignProgress& state) {
    context.progress.step(variant, record);
    check_light(record, variant);
    save_checkpoint(point_checkpoint(context.checkpoint, point), identity, state);
    context.progress.begin(fmt::format("point {}, step {}", point + 1, record.step + 1));
  };
  hooks.finished = [&context](int point, const design::FrontPoint& result) {
    context.progress.line(fmt::format("point {}: {}", point + 1, point_note(result)));
  };
  return hooks;
}

std::filesystem::path point_checkpoint(const std::filesystem::path& first, int point) {
  if (point == 0) return first;
  return first.parent_path() / fmt::format("checkpoint_{}.json", point);
}

void remove_point_checkpoints(const std::filesystem::path& first) {
  std::error_code ignored;
  for (int i = 1; std::filesystem::remove(point_checkpoint(first, i), ignored); ++i) {
  }
  std::filesystem::remove(first, ignored);
}

namespace {

/// The goal max_efficiency: designs at several levels, the best of them judged once more.
std::optional<Report> run_efficiency_job(Run run, const RunContext& context) {
  const Stopwatch watch;
  Report report = describe_run(run, context);
  const std::string identity = run_identity(run, context.stream);
  design::DesignSpec spec = run.design;
  spec.stop_rms = spec.goal.rms;
  const tracer::DensityField start = design::first_density(run.backlight, spec);
  const design::DesignLimits limits = design_limits(run);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  SearchLog log;
  design::FrontHooks hooks = front_hooks(run, context, identity);
  hooks.stepped = [&log, told = hooks.stepped](int point, const design::StepRecord& record,
                                               const design::DesignProgress& state) {
    told(point, record, state);
    log.steps.resize(static_cast<std::size_t>(point) + 1);
    log.start_luminance.resize(log.steps.size());
    log.steps.back() = state.steps;
    log.start_luminance.back() = state.start_luminance;
  };
  // A point that had ended before the interruption makes no further steps: its log is that of its checkpoint.
  hooks.load = [&log, load = hooks.load](int point) {
    auto state = load(point);
    if (state) {
      log.steps.resize(static_cast<std::size_t>(point) + 1);
      log.start_luminance.resize(log.steps.size());
      log.steps.back() = state->steps;
      log.start_luminance.back() = state->start_luminance;
    }
    return state;
  };
  const design::FrontJob job{model, spec, limits, start};
  context.progress.begin(label(run, "point 1, step 0"));
  const auto search = design_most_efficient(job, start.cells.mean(), hooks);
  if (!search) return std::nullopt;
  const design::FrontPoint& best = search->points[search->best];
  context.progress.begin(label(run, "final trace"));
  const auto observation = model({best.density}, run.trace.photons, design::kJudgingStep - 1000U);
  if (!observation) return std::nullopt;
  report.stop_reason =
      search->feasible
          ? fmt::format("max_efficiency: the best of {} levels whose RMS keeps {:.2f} %", search->points.size(),
                        100.0 * spec.goal.rms)
          : fmt::format("max_efficiency: no level of {} keeps an RMS of {:.2f} %; the most even one is shown",
                        search->points.size(), 100.0 * spec.goal.rms);
  report.density = best.density;
  report.steps = log.steps[search->best];
  report.start_luminance = log.start_luminance[search->best];
  for (const design::FrontPoint& point : search->points) report.notes.push_back(point_note(point));
  take_observation(scene, spec, *observation, report);
  finish_timing(watch, report);
  for (int i = 1; i < static_cast<int>(search->points.size()); ++i)
    std::filesystem::remove(point_checkpoint(context.checkpoint, i));
  return report;
}

}  // namespace

std::optional<Report> run_design_job(Run run, const RunContext& context) {
  if (run.design.goal.kind == "max_efficiency") return run_efficiency_job(std::move(run), context);
  const Stopwatch watch;
  Report report = describe_run(run, context);
  const design::DesignLimits limits = design_limits(run);
  design::DesignProgress progress = begin_design(run, limits, context);
  const std::string identity = run_identity(run, context.stream);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  const auto observer = [&](const design::StepRecord& record, const design::DesignProgress& state) {
    context.progress.step(run.variant, record);
    check_light(record, run.variant);
    if (!context.checkpoint.empty()) save_checkpoint(context.checkpoint, identity, state);
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
  report.notes.insert(report.notes.end(), progress.notes.begin(), progress.notes.end());
  report.notes.insert(report.notes.end(), progress.limit_notes.begin(), progress.limit_notes.end());
  take_observation(scene, run.design, *observation, report);
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
