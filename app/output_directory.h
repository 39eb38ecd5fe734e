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

/// The folder of a result directory that holds the dots of its design.
inline constexpr const char* kDotsFolder = "dots";

/// Name of the results of `file`: its stem, or `run` where that is none (`...yaml`, whose stem `..` is another folder).
std::string run_name(const std::filesystem::path& file);

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
                           const Options& options, std::size_t bytes = 0);

/// Writes the results by `write`, if the lock holds. If that fails (a full disk), the message says that the state is
/// kept and how to go on.
void write_results(const std::filesystem::path& directory, const OutputLock& lock, const std::function<void()>& write);

/// Makes the directory and proves that `bytes` and 2 MiB more can be written to it, before hours are spent. Throws
/// Error if they cannot.
void make_directory(const std::filesystem::path& directory, std::size_t bytes = 0);

/// Refuses (ConfigError) a folder in a directory that is a symbolic link: the user names the directory, which may be
/// one; what lies in it may be of anyone.
void check_is_no_link(const std::filesystem::path& place);

/// Makes the folder `name` of a variant or run in the directory. Refuses (ConfigError) a symbolic link: what is written
/// to the directory stays in it.
std::filesystem::path make_subdirectory(const std::filesystem::path& directory, const std::string& name,
                                        std::size_t bytes = 0);

/// Removes the files of an earlier result and of its dots, that none of them stays beside the new ones; the checkpoint
/// stays.
void clear_results(const std::filesystem::path& directory);

}  // namespace evenglow::app
