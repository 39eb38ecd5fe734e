#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "design/report/report.h"

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

/// One trace of the backlight as described; empty: interrupted.
std::optional<design::Report> run_simulation(Run run, const RunContext& context);

/// The design loop and its judgment; empty: interrupted, the state is in the checkpoint.
std::optional<design::Report> run_design_job(Run run, const RunContext& context);

/// A short table of the result for stdout.
void print_result(const design::Report& report, const std::filesystem::path& directory);

}  // namespace evenglow::app
