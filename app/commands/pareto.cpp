#include <fmt/core.h>

#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/front_report.h"
#include "app/front_run.h"
#include "app/output_directory.h"
#include "core/config/message_text.h"
#include "design/engine/design_start.h"
#include "design/engine/level_front.h"
#include "tracer/scene/refined_density.h"

namespace evenglow::app {

namespace {

constexpr const char* kWork = "pareto";

}  // namespace

int pareto_command(const Session& session) {
  const auto& file = session.options.files.front();
  Run run = read_run(file, session.options, Purpose::kDesign);
  agree_on_input(session.options, run_identity(run, kWork), session.stop);
  const auto directory = output_directory(session.options, file);
  const OutputLock lock = claim_directory(directory, {}, session.options, disk_bytes(run));
  Progress progress(session.options.quiet, session.options.json_progress);
  const RunContext context{
      session.options, progress, session.stop, session.program_arguments, 0, directory / kCheckpointName, &lock, kWork};
  if (!session.options.resume) remove_point_checkpoints(context.checkpoint);
  const tracer::DensityField start = design::first_density(run.backlight, run.design);
  const design::DesignLimits limits = design_limits(run);
  const design::FrontHooks hooks = front_hooks(run, context);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  const auto levels = run.design.pareto_levels.empty() ? front_levels(run.design, start) : run.design.pareto_levels;
  progress.begin("point 1, step 0");
  auto points = design_front({model, run.design, limits, start}, levels, hooks);
  if (!points) {
    progress.line("interrupted: --resume goes on from the last whole step");
    return kInterrupted;
  }
  for (design::FrontPoint& point : *points) point.density = tracer::traced_density(scene.spec, {point.density}).cells;
  const design::Study study = front_study(run, session.program_arguments, *points);
  write_results(directory, lock, [&] {
    clear_results(directory);
    write_front(study, run, *points, directory);
  });
  remove_point_checkpoints(context.checkpoint);
  fmt::print("{}\n{}files: {}\n", core::one_line(study.title), design::study_text(study),
             core::one_line(directory.string()));
  return kDone;
}

}  // namespace evenglow::app
