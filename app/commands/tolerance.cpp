#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/result_text.h"
#include "app/tolerance_report.h"
#include "app/tolerance_run.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/state_file.h"
#include "design/report/writer_registry.h"
#include "design/tolerance/figures.h"

namespace evenglow::app {
namespace {

/// One sample whole, as `evenglow simulate` shows a backlight.
constexpr const char* kWork = "tolerance";

int replay(const Session& session, const ToleranceJob& job, const std::filesystem::path& directory,
           Progress& progress) {
  const int number = *session.options.sample;
  Run run = number == 0 ? read_run(job.file, job.options) : make_sample(job, number).run;
  if (number == 0) set_density(run, job.density);
  run.title += number == 0 ? ": nominal design" : fmt::format(": sample {}", number);
  const auto formats = run.output;
  const RunContext context{session.options, progress, session.stop, session.program_arguments};
  const auto report = run_simulation(std::move(run), context);
  if (!report) {
    progress.line("interrupted: nothing was written");
    return kInterrupted;
  }
  clear_results(directory);
  design::write_report(*report, formats, directory);
  design::remove_state(directory / kCheckpointName);
  print_result(*report, directory);
  return kDone;
}

void check_sample(const ToleranceJob& job) {
  if (job.options.sample && job.options.resume) {
    throw core::ConfigError(core::Fault{"--sample", 0, 0, "", "must not stand beside --resume: it replays one sample"});
  }
  const int samples = job.nominal.tolerance.samples;
  if (!job.options.sample || *job.options.sample <= samples) return;
  throw core::ConfigError(
      core::Fault{"--sample", 0, 0, "",
                  fmt::format("must lie in [0, {}], the samples of the run (tolerance.samples), got {}", samples,
                              *job.options.sample)});
}

void print(const ToleranceOutcome& outcome, const std::filesystem::path& directory) {
  const design::Study study = tolerance_study(outcome);
  design::Study yields;
  yields.columns = yield_columns();
  yields.rows = yield_rows(outcome);
  std::string worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, outcome.summary.worst.size()); ++i)
    worst += (i == 0 ? "" : ", ") + std::to_string(outcome.summary.worst[i]);
  fmt::print("{}\n{}", study.title, design::study_text(study));
  if (!yields.rows.empty()) fmt::print("{}", design::study_text(yields));
  fmt::print("worst samples: {} (--sample N shows one whole)\nfiles: {}\n", worst, core::one_line(directory.string()));
}

/// What the samples may take on the disk beyond what all runs do: three states, each number with 25 characters at most,
/// and a row of tolerance.csv.
std::size_t sample_bytes(const ToleranceJob& job) {
  const design::ToleranceSpec& spec = job.nominal.tolerance;
  const std::size_t numbers = design::parameter_names(spec).size() + 2 * design::kFigures.size() + 4;
  return static_cast<std::size_t>(spec.samples) * 4 * 25 * numbers;
}

}  // namespace

int tolerance_command(const Session& session) {
  const auto& file = session.options.files.front();
  const ToleranceJob job = read_tolerance_job(session.options);
  check_sample(job);
  const auto directory = output_directory(session.options, file);
  agree_on_input(session.options, run_identity(job.nominal, kWork), session.stop);
  const OutputLock lock = claim_directory(directory, {}, session.options, disk_bytes(job.nominal) + sample_bytes(job));
  Progress progress(session.options.quiet, session.options.json_progress);
  if (session.options.sample) return replay(session, job, directory, progress);
  const RunContext context{
      session.options, progress, session.stop, session.program_arguments, 0, directory / kCheckpointName, &lock, kWork};
  const auto samples = run_tolerance(job, context);
  if (!samples) {
    progress.line("interrupted: --resume goes on from the last whole sample");
    return kInterrupted;
  }
  const design::ToleranceSummary summary = summarize(job.nominal.tolerance, *samples);
  const ToleranceOutcome outcome{job, *samples, summary, session.program_arguments};
  write_results(directory, lock, [&] {
    clear_results(directory);
    write_tolerance(outcome, directory);
  });
  design::remove_state(context.checkpoint);
  print(outcome, directory);
  return kDone;
}

}  // namespace evenglow::app
