#include "app/batch_job.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/batch_earlier.h"
#include "app/output_directory.h"
#include "app/repeating_command.h"
#include "core/base/version.h"
#include "core/config/message_text.h"
#include "design/engine/state_file.h"
#include "design/report/number_format.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {
namespace {

using design::BatchRow;
using design::BatchStatus;

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

}  // namespace

BatchJob::BatchJob(const Session& session, std::vector<PlannedRun> plan, std::filesystem::path directory)
    : session_(session),
      plan_(std::move(plan)),
      directory_(std::move(directory)),
      earlier_(earlier_batch(directory_, session.options)),
      progress_(session.options.quiet, session.options.json_progress) {
  table_.title = session.options.files.size() == 1 ? session.options.files.front().stem().string() : "Batch";
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
  design::write_batch_json(table_, directory_);
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
    row.identity = identity(run);
    return trace(std::move(run), row);
  } catch (const std::exception& error) {
    row.status = BatchStatus::kFailed;
    row.message = core::one_line(error.what());
    progress_.line(row.name + ": failed: " + row.message);
    return true;
  }
}

bool BatchJob::trace(Run run, BatchRow& row) {
  const auto place = directory_ / row.name;
  make_directory(place);
  const OutputLock lock(place);
  const auto formats = run.output;
  run.variant = row.name;
  const RunContext context{session_.options, progress_, session_.stop, single_command(row), 0, place / kCheckpointName};
  const auto report =
      session_.options.simulate ? run_simulation(std::move(run), context) : run_design_job(std::move(run), context);
  if (!report) return false;
  write_results(place, [&] {
    clear_results(place);
    design::write_report(*report, formats, place);
    design::write_thumbnail(report->luminance, place / "thumbnail.png");
  });
  design::remove_state(context.checkpoint);
  row.status = BatchStatus::kDone;
  row.message = report->stop_reason;
  row.final = report->final;
  row.cpu_s = report->timing.cpu_s;
  ++made_;
  progress_.line(fmt::format("{}: {}", row.name, in_words(row)));
  return true;
}

std::string BatchJob::identity(const Run& run) const {
  return run_identity(run, 0) + (session_.options.simulate ? "-simulate" : "-design");
}

/// Before the first save: else a batch that is killed as it goes on has forgotten what was done.
void BatchJob::take_earlier_rows() {
  if (!session_.options.resume) return;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    BatchRow& row = table_.rows[i];
    if (row.status == BatchStatus::kWrongInput) continue;
    try {
      row.identity = identity(read_point(plan_[i].file, plan_[i].point, session_.options, purpose()));
    } catch (const std::exception&) {
      continue;  // it is told when its turn comes
    }
    progress_.prefix(overall(i));
    if (take_earlier(row)) progress_.line(row.name + ": done before");
  }
}

/// A run that is done, with the same description, is not made again.
bool BatchJob::take_earlier(BatchRow& row) const {
  const auto found = std::find_if(earlier_.rows.begin(), earlier_.rows.end(),
                                  [&](const BatchRow& earlier) { return earlier.name == row.name; });
  std::error_code ignored;
  if (found == earlier_.rows.end() || found->status != BatchStatus::kDone || found->identity != row.identity ||
      !std::filesystem::exists(directory_ / row.name, ignored)) {
    return false;
  }
  row = *found;
  return true;
}

std::string BatchJob::single_command(const BatchRow& row) const {
  Options options = session_.options;
  options.files = {row.file};
  std::vector<std::string> changes;
  for (const auto& [key, value] : row.changes) changes.push_back(key + "=" + value);
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
  fmt::print("files: {}\n", directory_.string());
  return done == table_.rows.size() ? kDone : kFailed;
}

Purpose BatchJob::purpose() const {
  return session_.options.simulate ? Purpose::kTrace : Purpose::kDesign;
}

}  // namespace evenglow::app
