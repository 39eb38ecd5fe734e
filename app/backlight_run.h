#pragma once

#include <functional>
#include <optional>

#include "app/run_context.h"
#include "design/report/report.h"

namespace evenglow::app {

/// One trace of the backlight as described; empty: interrupted.
std::optional<design::Report> run_simulation(Run run, const RunContext& context);

/// A design that is to be written.
struct DesignedRun {
  design::Report report;
  std::function<void()> write_more;  ///< the files of its dots, after those of the report; empty: none. While the
                                     ///< context lives
};

/// The design loop and its judgment; empty: interrupted, the state is in the checkpoint.
std::optional<DesignedRun> run_design_job(Run run, const RunContext& context);

}  // namespace evenglow::app
