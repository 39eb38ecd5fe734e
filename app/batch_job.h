#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/backlight_run.h"
#include "app/batch_plan.h"
#include "app/commands/commands.h"
#include "app/progress.h"
#include "design/report/batch_table.h"

namespace evenglow::app {

/// One batch on its way: run after run, each in a folder of its own, one summary. What fails does not stop the others.
class BatchJob {
 public:
  /// Error if `directory` holds a batch to go on with whose summary cannot be read.
  BatchJob(const Session& session, std::vector<PlannedRun> plan, std::filesystem::path directory,
           const OutputLock& lock);

  /// The exit code. The summary is saved after every run, so that `--resume` knows from it what is done.
  int run();

 private:
  using Clock = std::chrono::steady_clock;

  void take_earlier_rows();
  bool take_earlier(design::BatchRow& row, const Run& run) const;
  void agree_on_rows();
  bool run_one(std::size_t i);
  bool trace(Run run, design::BatchRow& row);
  void save() const;
  void save_pages();
  int verdict() const;
  std::string single_command(const design::BatchRow& row) const;
  std::string overall(std::size_t i) const;
  Purpose purpose() const;

  const Session& session_;
  std::vector<PlannedRun> plan_;
  std::filesystem::path directory_;
  const OutputLock& lock_;
  design::BatchTable earlier_;
  design::BatchTable table_;
  Progress progress_;
  int made_ = 0;  // runs of this call
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_pages_ = start_;
};

}  // namespace evenglow::app
