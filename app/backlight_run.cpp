#include "app/backlight_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "app/dots_verify.h"
#include "app/front_run.h"
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

/// The state to go on from; none if there is no checkpoint.
std::optional<design::DesignProgress> load_state(const Run& run, const RunContext& context) {
  try {
    std::string note;
    const design::StateBounds bounds = state_bounds(run);
    auto state =
        design::load_checkpoint(context.checkpoint, run_identity(run, context.work, context.stream), &note, &bounds);
    if (!note.empty()) context.progress.line(label(run, note));
    return state;
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
  remove_point_checkpoints(context.checkpoint);  // of a run that is begun anew
  return design::start_design(design::first_density(run.backlight, run.design), run.design, limits);
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
  report.density = tracer::traced_density(scene.spec, density).cells;
  report.steps = {make_step_record(0, density, *observation, run.design)};
  report.start_luminance = observation->map.luminance;
  take_observation(scene, run.design, *observation, report);
  finish_timing(watch, report);
  report.timing.photons_per_cpu_s = static_cast<double>(observation->photons) / std::max(observation->cpu_s, 1e-9);
  return report;
}

std::optional<DesignedRun> run_design_job(Run run, const RunContext& context) {
  if (run.design.goal.kind == "max_efficiency") {
    auto report = run_efficiency_job(std::move(run), context);
    return report ? std::make_optional(DesignedRun{std::move(*report), {}}) : std::nullopt;
  }
  const Stopwatch watch;
  const std::string dots_note = keep_to_dots(run);
  Report report = describe_run(run, context);
  if (!dots_note.empty()) report.notes.push_back(dots_note);
  const auto proof = run.design.verify_dots ? std::make_shared<const DotProof>(run) : nullptr;
  const design::DesignLimits limits = design_limits(run);
  design::DesignProgress progress = begin_design(run, limits, context);
  const std::string identity = run_identity(run, context.work, context.stream);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  const auto observer = [&](const design::StepRecord& record, const design::DesignProgress& state) {
    context.progress.step(run.variant, record);
    check_light(record, run.variant);
    context.check_lock();
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
  report.density = tracer::traced_density(scene.spec, progress.best_density).cells;
  report.steps = progress.steps;
  report.start_luminance = progress.start_luminance;
  if (!progress.level_note.empty()) report.notes.push_back(progress.level_note);
  report.notes.insert(report.notes.end(), progress.notes.begin(), progress.notes.end());
  report.notes.insert(report.notes.end(), progress.limit_notes.begin(), progress.limit_notes.end());
  take_observation(scene, run.design, *observation, report);
  report.stop_reason = confirmed_goal(confirmed_reason(progress.stop_reason, report.final, run.design.stop_rms),
                                      report.final, run.design.goal);
  tell_color(run.design, report);
  if (report.stop_reason != progress.stop_reason) context.progress.line(label(run, report.stop_reason));
  auto verified = std::make_shared<std::optional<design::VerifiedDots>>();
  if (proof && !proof->add_to(report, model, run.design, run.trace.photons, context, *verified)) return std::nullopt;
  finish_timing(watch, report);
  DesignedRun made{std::move(report), {}};
  if (*verified) made.write_more = [proof, verified, &context] { proof->write(**verified, context); };
  return made;
}

}  // namespace evenglow::app
