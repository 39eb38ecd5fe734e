#include "app/batch_job.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/batch_earlier.h"
#include "app/front_run.h"
#include "app/output_directory.h"
#include "app/repeating_command.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/config/message_text.h"
#include "core/parallel/ranks.h"
#include "design/engine/state_file.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {
namespace {

using design::BatchRow;
using design::BatchStatus;

constexpr const char* kThumbnail = "thumbnail.png";  // the last that a run writes

BatchRow waiting_row(const PlannedRun& run) {
  BatchRow row;
  row.name = run.name;
  row.file = run.file.string();
  for (const auto& change : run.point.changes) row.changes.emplace_back(change.path, change.yaml);
  if (run.faults.empty()) return row;
  row.status = BatchStatus::kWrongInput;
  row.message = run.faults.front().to_string();
  if (run.faults.size() > 1) row.message += fmt::format(" (and {} more faults)", run.faults.size() - 1);
  return row;
}

std::string in_words(const BatchRow& row) {
  return fmt::format("RMS {:.2f} +- {:.2f} %, luminance {:.1f} +- {:.1f} cd/m2, efficiency {:.2f} %",
                     100.0 * row.final.rms_corrected.value, 100.0 * row.final.rms_corrected.se,
                     row.final.luminance_mean.value, row.final.luminance_mean.se, 100.0 * row.final.efficiency.value);
}

std::optional<DesignedRun> simulated(Run run, const RunContext& context) {
  auto report = run_simulation(std::move(run), context);
  return report ? std::make_optional(DesignedRun{std::move(*report), {}}) : std::nullopt;
}

}  // namespace

BatchJob::BatchJob(const Session& session, std::vector<PlannedRun> plan, std::filesystem::path directory,
                   const OutputLock& lock)
    : session_(session),
      plan_(std::move(plan)),
      directory_(std::move(directory)),
      lock_(lock),
      earlier_(earlier_batch(directory_, session.options)),
      progress_(session.options.quiet, session.options.json_progress) {
  table_.title = session.options.files.size() == 1 ? run_name(session.options.files.front()) : "Batch";
  table_.version = core::version();
  table_.command = session.program_arguments + (session.options.simulate ? kSimulateOption : "");
  table_.left_over = left_over(earlier_, plan_, directory_);
  for (const PlannedRun& run : plan_) table_.rows.push_back(waiting_row(run));
}

int BatchJob::run() {
  take_earlier_rows();
  save();
  save_pages();
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    if (table_.rows[i].status != BatchStatus::kWaiting) continue;
    if (!run_one(i)) {
      save();
      save_pages();
      progress_.line("interrupted: --resume goes on where the batch was stopped");
      return kInterrupted;
    }
    save();
    if (table_.rows[i].status == BatchStatus::kFailed || Clock::now() >= next_pages_) save_pages();
  }
  save_pages();
  return verdict();
}

/// After every run: `--resume` knows from it what is done.
void BatchJob::save() const {
  lock_.check();
  design::write_file(directory_ / kBatchSummary, design::sealed_state(design::batch_json(table_)));
}

/// They hold all rows, with their pictures: written after every run they would cost the square of their number.
void BatchJob::save_pages() {
  const auto begin = Clock::now();
  design::write_batch_pages(table_, directory_);
  const auto end = Clock::now();
  next_pages_ = end + std::max<Clock::duration>(std::chrono::seconds(2), 10 * (end - begin));
}

/// False: interrupted. Whatever else happens to the run, the batch goes on.
bool BatchJob::run_one(std::size_t i) {
  const PlannedRun& planned = plan_[i];
  BatchRow& row = table_.rows[i];
  progress_.prefix(overall(i));
  try {
    Run run = read_point(planned.file, planned.point, session_.options, purpose());
    row.identity = batch_identity(run, purpose());
    if (row.identity != planned.identity) {
      throw core::Error(
          "the run file or a file that it names has changed since the batch began (--resume makes the run)");
    }
    return trace(std::move(run), row);
  } catch (const std::exception& error) {
    row.status = BatchStatus::kFailed;
    row.message = core::one_line(error.what());
    progress_.line(row.name + ": failed: " + row.message);
    return true;
  }
}

bool BatchJob::trace(Run run, BatchRow& row) {
  const auto place = make_subdirectory(directory_, row.name, disk_bytes(run));
  const OutputLock lock(place);
  const auto formats = run.output;
  run.variant = row.name;
  const RunContext context{session_.options,        progress_, session_.stop, single_command(row), 0,
                           place / kCheckpointName, &lock};
  const auto made =
      session_.options.simulate ? simulated(std::move(run), context) : run_design_job(std::move(run), context);
  if (!made) return false;
  const design::Report& report = made->report;
  write_results(place, lock, [&] {
    clear_results(place);
    design::write_report(report, formats, place);
    design::write_thumbnail(report.luminance, place / kThumbnail);
    if (made->write_more) made->write_more();
  });
  remove_point_checkpoints(context.checkpoint);
  row.status = BatchStatus::kDone;
  row.message = report.stop_reason;
  row.final = report.final;
  row.cpu_s = report.timing.cpu_s;
  ++made_;
  progress_.line(fmt::format("{}: {}", row.name, in_words(row)));
  return true;
}

/// Before the first save: else a batch that is killed as it goes on has forgotten what was done.
void BatchJob::take_earlier_rows() {
  if (!session_.options.resume) return;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    BatchRow& row = table_.rows[i];
    if (row.status == BatchStatus::kWrongInput) continue;
    row.identity = plan_[i].identity;
    try {
      const Run run = read_point(plan_[i].file, plan_[i].point, session_.options, purpose());
      progress_.prefix(overall(i));
      if (take_earlier(row, run)) progress_.line(row.name + ": done before");
    } catch (const std::exception&) {
      continue;  // it is told when its turn comes
    }
  }
  agree_on_rows();
}

/// A run that is done, with the same description, is not made again. A helper among several ranks has no results: rank
/// 0 tells it which are there.
bool BatchJob::take_earlier(BatchRow& row, const Run& run) const {
  const auto found = std::find_if(earlier_.rows.begin(), earlier_.rows.end(),
                                  [&](const BatchRow& earlier) { return earlier.name == row.name; });
  if (found == earlier_.rows.end() || found->status != BatchStatus::kDone || found->identity != row.identity) {
    return false;
  }
  const bool json = std::find(run.output.begin(), run.output.end(), "json") != run.output.end();
  std::error_code ignored;
  if (!session_.options.helper &&
      !std::filesystem::is_regular_file(directory_ / row.name / (json ? "result.json" : kThumbnail), ignored)) {
    return false;
  }
  row = *found;
  return true;
}

/// What rank 0 makes anew, all make anew.
void BatchJob::agree_on_rows() {
  core::RankGroup* ranks = session_.options.ranks;
  if (ranks == nullptr) return;
  std::string done;
  for (const BatchRow& row : table_.rows) done += row.status == BatchStatus::kDone ? '1' : '0';
  const std::string first = ranks->texts(done, session_.stop).front();
  core::expects(first.size() == done.size(), "all ranks have one plan");
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (done[i] == first[i]) continue;
    core::expects(done[i] == '1', "a helper knows all that is done");
    table_.rows[i] = waiting_row(plan_[i]);
    table_.rows[i].identity = plan_[i].identity;
  }
}

std::string BatchJob::single_command(const BatchRow& row) const {
  Options options = session_.options;
  options.files = {row.file};
  std::vector<std::string> changes;
  changes.reserve(row.changes.size());
  for (const auto& [key, value] : row.changes) changes.push_back(fmt::format("{}={}", key, value));
  options.set.insert(options.set.begin(), changes.begin(), changes.end());
  return repeating_command(session_.options.simulate ? "simulate" : "design", options);
}

/// `[3/20, 12 min left] `, by the time that the runs of this call have taken.
std::string BatchJob::overall(std::size_t i) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const auto waiting = std::count_if(table_.rows.begin(), table_.rows.end(),
                                     [](const BatchRow& row) { return row.status == BatchStatus::kWaiting; });
  const std::string left =
      made_ == 0 ? std::string()
                 : fmt::format(", {} left", design::duration(seconds / made_ * static_cast<double>(waiting)));
  return fmt::format("[{}/{}{}] ", i + 1, plan_.size(), left);
}

int BatchJob::verdict() const {
  std::size_t done = 0;
  for (const BatchRow& row : table_.rows) {
    const bool is_done = row.status == BatchStatus::kDone;
    done += is_done ? 1 : 0;
    fmt::print("{:<40} {}\n", row.name,
               is_done ? in_words(row) : std::string(design::status_name(row.status)) + ": " + row.message);
  }
  fmt::print("{} of {} runs done\n", done, table_.rows.size());
  if (!table_.left_over.empty()) fmt::print("{}\n", design::left_over_text(table_));
  fmt::print("files: {}\n", core::one_line(directory_.string()));
  return done == table_.rows.size() ? kDone : kFailed;
}

Purpose BatchJob::purpose() const {
  return session_.options.simulate ? Purpose::kTrace : Purpose::kDesign;
}

}  // namespace evenglow::app
