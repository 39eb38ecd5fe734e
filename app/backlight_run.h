#pragma once

#include <optional>

#include "app/run_context.h"
#include "design/report/report.h"

namespace evenglow::app {

/// One trace of the backlight as described; empty: interrupted.
std::optional<design::Report> run_simulation(Run run, const RunContext& context);

/// The design loop and its judgment; empty: interrupted, the state is in the checkpoint.
std::optional<design::Report> run_design_job(Run run, const RunContext& context);

}  // namespace evenglow::app
