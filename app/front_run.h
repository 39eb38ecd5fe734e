#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/run_context.h"
#include "design/engine/level_front.h"
#include "design/report/report.h"

/// Designs at several levels of the density.
namespace evenglow::app {

/// For designs at several levels: progress, checkpoints of each point beside that of the context, `--resume`. Keeps a
/// reference to the context. The state of a point is of that point alone, and of the context's command.
design::FrontHooks front_hooks(const Run& run, const RunContext& context);

/// `checkpoint.json` for point 0, `checkpoint_1.json` beside it for point 1, and so on.
std::filesystem::path point_checkpoint(const std::filesystem::path& first, int point);
void remove_point_checkpoints(const std::filesystem::path& first);

/// The goal max_efficiency: designs at several levels, the best of them judged once more. Empty: interrupted.
std::optional<design::Report> run_efficiency_job(Run run, const RunContext& context);

}  // namespace evenglow::app
