#include "app/batch_earlier.h"

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"
#include "design/engine/state_file.h"

namespace evenglow::app {
namespace {

using design::BatchRow;
using design::BatchTable;

constexpr std::size_t kMaxSummaryBytes = std::size_t{32} << 20;

/// Traces do not go on as designs, nor designs as traces.
void check_same_purpose(const BatchTable& earlier, const std::filesystem::path& file, const Options& options) {
  const bool traced = earlier.command.ends_with(kSimulateOption);
  if (traced == options.simulate || options.overwrite) return;
  throw core::ConfigError(core::Fault{"--resume", 0, 0, "",
                                      core::one_line(file.string()) +
                                          (traced ? " is of a batch of single traces, go on with --simulate"
                                                  : " is of a batch of designs, go on without --simulate") +
                                          " (--overwrite begins anew, -o chooses another directory)"});
}

}  // namespace

BatchTable earlier_batch(const std::filesystem::path& directory, const Options& options) {
  const auto file = directory / kBatchSummary;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    BatchTable earlier = design::read_batch_json(design::unsealed_state(core::read_text_file(file, kMaxSummaryBytes)));
    if (options.resume) check_same_purpose(earlier, file, options);
    return earlier;
  } catch (const core::Error& error) {
    if (!options.resume) return {};  // it is replaced, whatever it was
    if (dynamic_cast<const core::ConfigError*>(&error) != nullptr) throw;
    throw core::ConfigError(
        core::Fault{file.string(), 0, 0, "", std::string(error.what()) + " (--overwrite begins anew)"});
  }
}

std::vector<std::string> left_over(const BatchTable& earlier, const std::vector<PlannedRun>& plan,
                                   const std::filesystem::path& directory) {
  std::set<std::string> passed;
  for (const PlannedRun& run : plan) passed.insert(run.name);
  std::vector<std::string> names = earlier.left_over;
  for (const BatchRow& row : earlier.rows) names.push_back(row.name);
  std::vector<std::string> left;
  std::error_code ignored;
  for (const std::string& name : names) {
    if (passed.insert(name).second && std::filesystem::is_directory(directory / name, ignored)) left.push_back(name);
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace evenglow::app
