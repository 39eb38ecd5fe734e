#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/options.h"
#include "app/output_lock.h"

namespace evenglow::app {

/// The state of an interrupted design, in its output directory; a finished one leaves none.
inline constexpr const char* kCheckpointName = "checkpoint.json";
/// The state of the step before, beside it.
inline constexpr const char* kPreviousCheckpointName = "checkpoint.previous.json";

/// Where the results of `file` go: the option, or out/<name of the file>.
std::filesystem::path output_directory(const Options& options, const std::filesystem::path& file);

/// Whether a run writes a file of this name: no variant may be called so.
bool is_result_name(std::string_view name);

/// Refuses (ConfigError) a directory that holds a result or the state of an interrupted run, in itself or in one of the
/// folders `variants` that a comparison would write to, unless `--overwrite` allows it, or `--resume` does and there is
/// a state to go on from. Makes nothing.
void check_free(const std::filesystem::path& directory, const std::vector<std::string>& variants,
                const Options& options);

/// All that comes before the first photon: refuses a directory in which another run is at work, and what `check_free`
/// refuses; makes the directory, proves it and keeps it for this run as long as the result lives.
OutputLock claim_directory(const std::filesystem::path& directory, const std::vector<std::string>& variants,
                           const Options& options);

/// Writes the results by `write`. If that fails (a full disk), the message says that the state is kept and how to go
/// on.
void write_results(const std::filesystem::path& directory, const std::function<void()>& write);

/// Makes the directory and proves that it can be written to (2 MiB), before hours are spent. Throws Error if it cannot.
void make_directory(const std::filesystem::path& directory);

/// Removes the files of an earlier result, that none of them stays beside the new ones; the checkpoint stays.
void clear_results(const std::filesystem::path& directory);

}  // namespace evenglow::app
