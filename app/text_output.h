#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace evenglow::app {

/// Refuses (`core::ConfigError`) paths that exist: only `--overwrite` may replace them.
void require_free(const std::vector<std::filesystem::path>& paths);

/// Refuses (`core::ConfigError`) outputs that are the same file as an input, by whatever name: not even `--overwrite`
/// may replace what is read.
void require_other_than_inputs(const std::vector<std::filesystem::path>& outputs,
                               const std::vector<std::filesystem::path>& inputs);

/// Writes a file whole or not at all: beside it first, then renamed. Makes the directory if there is none. Throws
/// `core::Error`.
void write_whole(const std::filesystem::path& path, const std::string& text);

}  // namespace evenglow::app
