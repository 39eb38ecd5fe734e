#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "app/batch_job.h"
#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/run_context.h"

namespace evenglow::app {
namespace {

void tell_faults(const std::vector<PlannedRun>& plan, bool json) {
  std::set<std::string> told;  // a fault of a file shows in all of its runs
  for (const PlannedRun& run : plan) {
    for (const core::Fault& fault : run.faults) {
      const std::string text = fault.to_string();
      if (told.insert(text).second) tell("fault", text, json);
    }
  }
}

/// The folders of a batch must be free, or be those of the batch that goes on.
void check_places(const std::filesystem::path& directory, const std::vector<PlannedRun>& plan, const Options& options) {
  if (options.resume) return;
  std::vector<std::string> places;
  places.reserve(plan.size());
  for (const PlannedRun& run : plan) places.push_back(run.name);
  check_free(directory, places, options);
}

}  // namespace

std::filesystem::path batch_directory(const Options& options) {
  if (options.files.size() == 1 || !options.out.empty()) return output_directory(options, options.files.front());
  return std::filesystem::path("out") / "batch";
}

int batch_command(const Session& session) {
  const Options& options = session.options;
  std::vector<PlannedRun> plan = plan_batch(options, options.simulate ? Purpose::kTrace : Purpose::kDesign);
  std::string identity;
  for (const PlannedRun& run : plan) identity += run.name + ' ' + run.identity + '\n';
  agree_on_input(options, identity, session.stop);
  const bool none_good =
      std::all_of(plan.begin(), plan.end(), [](const PlannedRun& run) { return !run.faults.empty(); });
  tell_faults(plan, options.json_progress);
  if (none_good) return kWrongInput;
  const auto directory = batch_directory(options);
  check_not_in_use(directory);
  check_places(directory, plan, options);
  make_directory(directory);
  const OutputLock lock(directory);
  check_places(directory, plan, options);
  return BatchJob(session, std::move(plan), directory, lock).run();
}

}  // namespace evenglow::app
