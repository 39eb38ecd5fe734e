#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "app/options.h"

namespace evenglow::app {

/// What main hands to every command.
struct Session {
  Options options;
  std::stop_token stop;
  std::string program_arguments;  ///< the words after the program's name that change a result, as typed
};

/// Each returns the exit code; wrong input leaves as ConfigError.
int check_command(const Session& session);
int simulate_command(const Session& session);
int design_command(const Session& session);
int compare_command(const Session& session);
int pareto_command(const Session& session);
int optimize_command(const Session& session);
int tolerance_command(const Session& session);
int batch_command(const Session& session);
/// Where a batch goes.
std::filesystem::path batch_directory(const Options& options);
int schema_command(const Session& session);
int trace_command(const Session& session);
int paths_command(const Session& session);

}  // namespace evenglow::app
