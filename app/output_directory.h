#pragma once

#include <filesystem>

#include "app/options.h"

namespace evenglow::app {

/// Where the results of `file` go: the option, or out/<name of the file>.
std::filesystem::path output_directory(const Options& options, const std::filesystem::path& file);

/// Refuses (ConfigError) a directory that holds a result or the state of an interrupted run, unless the options allow it
/// (`--overwrite`, `--resume`). Makes nothing.
void check_free(const std::filesystem::path& directory, const Options& options);

/// Makes the directory and proves that it can be written to, before hours are spent. Throws Error if it cannot.
void make_directory(const std::filesystem::path& directory);

}  // namespace evenglow::app
