#include "app/front_run.h"

#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/run_report.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/checkpoint.h"
#include "design/engine/design_start.h"
#include "design/engine/state_file.h"
#include "design/engine/stop_rule.h"
#include "design/engine/traced_model.h"
#include "tracer/scene/refined_density.h"

namespace evenglow::app {
namespace {

using design::Report;

/// What became of each design of a search.
struct SearchLog {
  std::vector<std::vector<design::StepRecord>> steps;
  std::vector<core::CellField> start_luminance;
};

std::string point_note(const design::FrontPoint& point) {
  const std::string color = point.color ? fmt::format(", color RMS {:.5f} +- {:.5f}{}", point.color->value,
                                                      point.color->se, point.breaks_color ? " (above its bound)" : "")
                                        : "";
  return fmt::format("Level {:.4f}: RMS {:.2f} +- {:.2f} %, efficiency {:.2f} +- {:.2f} %{}, {} steps.", point.level,
                     100.0 * point.judged.rms_corrected.value, 100.0 * point.judged.rms_corrected.se,
                     100.0 * point.judged.efficiency.value, 100.0 * point.judged.efficiency.se, color, point.steps);
}

}  // namespace

design::FrontHooks front_hooks(const Run& run, const RunContext& context) {
  design::FrontHooks hooks;
  const std::string whole = run_identity(run, context.work, context.stream);
  const auto identity = [whole](int point) { return fmt::format("{}, point {}", whole, point + 1); };
  hooks.load = [&context, identity, bounds = state_bounds(run)](int point) -> std::optional<design::DesignProgress> {
    if (!context.options.resume) {
      design::remove_state(point_checkpoint(context.checkpoint, point));
      return std::nullopt;
    }
    try {
      std::string note;
      auto state =
          design::load_checkpoint(point_checkpoint(context.checkpoint, point), identity(point), &note, &bounds);
      if (!note.empty()) context.progress.line(fmt::format("point {}: {}", point + 1, note));
      return state;
    } catch (const core::Error& error) {
      throw core::ConfigError(
          core::Fault{"--resume", 0, 0, "", core::one_line(error.what()) + " (--overwrite begins anew)"});
    }
  };
  hooks.stepped = [&context, identity, variant = run.variant](int point, const design::StepRecord& record,
                                                              const design::DesignProgress& state) {
    context.progress.step(variant, record);
    check_light(record, variant);
    context.check_lock();
    save_checkpoint(point_checkpoint(context.checkpoint, point), identity(point), state);
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
  if (first.empty()) return;
  std::error_code ignored;
  for (int i = 1; std::filesystem::exists(point_checkpoint(first, i), ignored) ||
                  std::filesystem::exists(design::previous_state(point_checkpoint(first, i)), ignored);
       ++i) {
    design::remove_state(point_checkpoint(first, i));
  }
  design::remove_state(first);
}

std::optional<Report> run_efficiency_job(Run run, const RunContext& context) {
  const Stopwatch watch;
  if (!context.options.resume) remove_point_checkpoints(context.checkpoint);  // also those that this one may not reach
  Report report = describe_run(run, context);
  design::DesignSpec spec = run.design;
  spec.stop_rms = spec.goal.rms;
  const tracer::DensityField start = design::first_density(run.backlight, spec);
  const design::DesignLimits limits = design_limits(run);
  design::FrontHooks hooks = front_hooks(run, context);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  SearchLog log;
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
  const std::string color = spec.goal.color ? fmt::format(" and a color RMS of {:.5g}", *spec.goal.color) : "";
  report.stop_reason =
      search->feasible
          ? fmt::format("max_efficiency: the best of {} levels whose RMS keeps {:.2f} %{}", search->points.size(),
                        100.0 * spec.goal.rms, color)
          : fmt::format("max_efficiency: no level of {} keeps an RMS of {:.2f} %{}; the most even one is shown",
                        search->points.size(), 100.0 * spec.goal.rms, color);
  report.density = tracer::traced_density(scene.spec, {best.density}).cells;
  report.steps = log.steps[search->best];
  report.start_luminance = log.start_luminance[search->best];
  for (const design::FrontPoint& point : search->points) report.notes.push_back(point_note(point));
  take_observation(scene, spec, *observation, report);
  if (search->feasible && !design::shows_bound(report.final.rms_corrected, spec.goal.rms)) {
    report.stop_reason += fmt::format("; the final trace does not show it: {:.2f} +- {:.2f} %",
                                      100.0 * report.final.rms_corrected.value, 100.0 * report.final.rms_corrected.se);
  }
  tell_color(spec, report);
  finish_timing(watch, report);
  return report;
}

}  // namespace evenglow::app
