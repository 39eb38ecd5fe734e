#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "app/backlight_run.h"
#include "app/batch_earlier.h"
#include "app/batch_plan.h"
#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/repeating_command.h"
#include "core/base/version.h"
#include "core/config/message_text.h"
#include "design/engine/state_file.h"
#include "design/report/batch_table.h"
#include "design/report/number_format.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {
namespace {

using design::BatchRow;
using design::BatchStatus;
using design::BatchTable;

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
  for (const PlannedRun& run : plan) places.push_back(run.name);
  check_free(directory, places, options);
}

/// One batch on its way.
class Batch {
 public:
  Batch(const Session& session, std::vector<PlannedRun> plan, std::filesystem::path directory)
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

  int run() {
    save();
    save_pages();
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      if (table_.rows[i].status == BatchStatus::kWrongInput) continue;
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

 private:
  using Clock = std::chrono::steady_clock;

  /// After every run: `--resume` knows from it what is done.
  void save() const { design::write_batch_json(table_, directory_); }

  /// They hold all rows, with their pictures: written after every run they would cost the square of their number.
  void save_pages() {
    const auto begin = Clock::now();
    design::write_batch_pages(table_, directory_);
    const auto end = Clock::now();
    next_pages_ = end + std::max<Clock::duration>(std::chrono::seconds(2), 10 * (end - begin));
  }

  /// False: interrupted. Whatever else happens to the run, the batch goes on.
  bool run_one(std::size_t i) {
    const PlannedRun& planned = plan_[i];
    BatchRow& row = table_.rows[i];
    progress_.prefix(overall(i));
    try {
      Run run = read_point(planned.file, planned.point, session_.options, purpose());
      row.identity = run_identity(run, 0) + (session_.options.simulate ? "-simulate" : "-design");
      if (take_earlier(row)) {
        progress_.line(row.name + ": done before");
        return true;
      }
      return trace(std::move(run), row);
    } catch (const std::exception& error) {
      row.status = BatchStatus::kFailed;
      row.message = core::one_line(error.what());
      progress_.line(row.name + ": failed: " + row.message);
      return true;
    }
  }

  bool trace(Run run, BatchRow& row) {
    const auto place = directory_ / row.name;
    make_directory(place);
    const OutputLock lock(place);
    const auto formats = run.output;
    run.variant = row.name;
    const RunContext context{session_.options,    progress_, session_.stop,
                             single_command(row), 0,         place / kCheckpointName};
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
    progress_.line(fmt::format("{}: {}", row.name, in_words(row)));
    return true;
  }

  /// A run that is done, with the same description, is not made again.
  bool take_earlier(BatchRow& row) const {
    if (!session_.options.resume) return false;
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

  std::string single_command(const BatchRow& row) const {
    Options options = session_.options;
    options.files = {row.file};
    std::vector<std::string> changes;
    for (const auto& [key, value] : row.changes) changes.push_back(key + "=" + value);
    options.set.insert(options.set.begin(), changes.begin(), changes.end());
    return repeating_command(session_.options.simulate ? "simulate" : "design", options);
  }

  /// `[3/20, 12 min left] `
  std::string overall(std::size_t i) const {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::string left =
        i == 0 ? ""
               : ", " + design::duration(seconds / static_cast<double>(i) * static_cast<double>(plan_.size() - i)) +
                     " left";
    return fmt::format("[{}/{}{}] ", i + 1, plan_.size(), left);
  }

  static std::string in_words(const BatchRow& row) {
    return fmt::format("RMS {:.2f} +- {:.2f} %, luminance {:.1f} +- {:.1f} cd/m2, efficiency {:.2f} %",
                       100.0 * row.final.rms_corrected.value, 100.0 * row.final.rms_corrected.se,
                       row.final.luminance_mean.value, row.final.luminance_mean.se, 100.0 * row.final.efficiency.value);
  }

  int verdict() const {
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

  Purpose purpose() const { return session_.options.simulate ? Purpose::kTrace : Purpose::kDesign; }

  const Session& session_;
  std::vector<PlannedRun> plan_;
  std::filesystem::path directory_;
  BatchTable earlier_;
  BatchTable table_;
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Clock::time_point next_pages_ = start_;
};

}  // namespace

std::filesystem::path batch_directory(const Options& options) {
  if (options.files.size() == 1 || !options.out.empty()) return output_directory(options, options.files.front());
  return std::filesystem::path("out") / "batch";
}

int batch_command(const Session& session) {
  const Options& options = session.options;
  std::vector<PlannedRun> plan = plan_batch(options, options.simulate ? Purpose::kTrace : Purpose::kDesign);
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
  return Batch(session, std::move(plan), directory).run();
}

}  // namespace evenglow::app
