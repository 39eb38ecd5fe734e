#include "app/batch_plan.h"

#include <set>
#include <utility>

#include <fmt/core.h>

#include "app/output_directory.h"
#include "app/run_context.h"

namespace evenglow::app {
namespace {

std::vector<RunPoint> points_of(const std::filesystem::path& file, std::vector<core::Fault>& faults) {
  try {
    return run_points(file);
  } catch (const core::ConfigError& error) {
    faults = error.faults();
    return {RunPoint{}};
  }
}

std::string folder_name(const std::filesystem::path& file, const RunPoint& point, bool several_files) {
  std::string stem = run_name(file);
  if (point.name.empty()) return stem;
  return several_files ? stem + "_" + point.name : point.name;
}

std::string free_name(const std::string& wish, std::set<std::string>& taken) {
  std::string name = wish;
  for (int i = 2; is_result_name(name) || !taken.insert(name).second; ++i) name = fmt::format("{}-{}", wish, i);
  return name;
}

void judge(PlannedRun& run, const Options& options, Purpose purpose) {
  try {
    run.identity = batch_identity(read_point(run.file, run.point, options, purpose), purpose);
  } catch (const core::ConfigError& error) {
    run.faults = error.faults();
  }
}

}  // namespace

std::string batch_identity(const Run& run, Purpose purpose) {
  return run_identity(run, purpose == Purpose::kTrace ? "batch --simulate" : "batch");
}

std::vector<PlannedRun> plan_batch(const Options& options, Purpose purpose) {
  option_overrides(options);  // a wrong --set is no fault of one run
  std::vector<PlannedRun> plan;
  std::set<std::string> names;
  for (const auto& file : options.files) {
    std::vector<core::Fault> faults;
    for (RunPoint& point : points_of(file, faults)) {
      PlannedRun run{free_name(folder_name(file, point, options.files.size() > 1), names), file, std::move(point),
                     faults};
      if (run.faults.empty()) judge(run, options, purpose);
      plan.push_back(std::move(run));
    }
  }
  return plan;
}

}  // namespace evenglow::app
