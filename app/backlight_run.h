#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "design/engine/design_loop.h"
#include "design/engine/level_front.h"
#include "design/report/report.h"
#include "tracer/scene/scene.h"

namespace evenglow::app {

/// What a run needs besides its description.
struct RunContext {
  const Options& options;
  Progress& progress;
  std::stop_token stop;
  std::string command;                 ///< repeats the run
  std::uint32_t stream = 0;            ///< number of the variant
  std::filesystem::path checkpoint{};  ///< of a design
};

/// A checksum of everything that the bits of a run depend on: run file, changes, data files, version and stream.
std::string run_identity(const Run& run, std::uint32_t stream);

/// Photons of the first and of the largest step of the run's design.
design::DesignLimits design_limits(const Run& run);

/// The forward model that traces the scene of the run; shows its progress.
design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context);

/// For designs at several levels: progress, checkpoints of each point beside that of the context, `--resume`. Keeps a
/// reference to the context.
design::FrontHooks front_hooks(const Run& run, const RunContext& context, const std::string& identity);

/// `checkpoint.json` for point 0, `checkpoint_1.json` beside it for point 1, and so on.
std::filesystem::path point_checkpoint(const std::filesystem::path& first, int point);
void remove_point_checkpoints(const std::filesystem::path& first);

/// One trace of the backlight as described; empty: interrupted.
std::optional<design::Report> run_simulation(Run run, const RunContext& context);

/// The design loop and its judgment; empty: interrupted, the state is in the checkpoint.
std::optional<design::Report> run_design_job(Run run, const RunContext& context);

/// A short table of the result for stdout.
void print_result(const design::Report& report, const std::filesystem::path& directory);

}  // namespace evenglow::app
