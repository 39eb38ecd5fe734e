#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/batch_plan.h"
#include "app/options.h"
#include "design/report/batch_table.h"

/// What an earlier batch has left in the directory of a new one.
namespace evenglow::app {

inline constexpr const char* kBatchSummary = "batch.json";
/// Behind the command of a batch of single traces.
inline constexpr const char* kSimulateOption = " --simulate";

/// The batch that was in the directory before; without rows if there was none, or if it is replaced. Throws ConfigError
/// where a batch that is to go on cannot be read, or was one of traces and is now one of designs, or the reverse.
design::BatchTable earlier_batch(const std::filesystem::path& directory, const Options& options);

/// Names of folders of the earlier batch that are there and that this one does not write to.
std::vector<std::string> left_over(const design::BatchTable& earlier, const std::vector<PlannedRun>& plan,
                                   const std::filesystem::path& directory);

}  // namespace evenglow::app
