#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/front_run.h"
#include "app/output_directory.h"
#include "app/result_text.h"
#include "core/config/message_text.h"
#include "design/report/writer_registry.h"

namespace evenglow::app {
namespace {

constexpr const char* kWork = "compare";

/// Each variant of a single file, or each of several files on its own.
std::vector<Run> read_all(const Options& options) {
  if (options.files.size() == 1) return read_variants(options.files.front(), options, Purpose::kDesign);
  std::vector<Run> runs;
  std::vector<core::Fault> faults;
  std::set<std::string> names;
  for (const auto& file : options.files) {
    try {
      Run run = read_run(file, options, Purpose::kDesign);
      run.variant = run_name(file);
      for (int i = 2; is_result_name(run.variant) || !names.insert(run.variant).second; ++i)
        run.variant = fmt::format("{}-{}", run_name(file), i);
      runs.push_back(std::move(run));
    } catch (const core::ConfigError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
  return runs;
}

void print_ratios(const design::Comparison& comparison) {
  for (const design::VariantRatio& ratio : comparison.ratios) {
    fmt::print("{:<20} luminance {:.4f} +- {:.4f}   flux {:.4f} +- {:.4f}   efficiency {:.4f} +- {:.4f}\n", ratio.name,
               ratio.luminance.value, ratio.luminance.se, ratio.flux.value, ratio.flux.se, ratio.efficiency.value,
               ratio.efficiency.se);
  }
}

}  // namespace

int compare_command(const Session& session) {
  std::vector<Run> runs = read_all(session.options);
  if (runs.size() < 2) {
    throw core::ConfigError(core::Fault{session.options.files.front().string(), 0, 0, "variants",
                                        "compare needs at least two variants, or several files, got one"});
  }
  const auto directory = output_directory(session.options, session.options.files.front());
  std::vector<std::string> places;
  std::string identity;
  std::size_t bytes = 0;
  places.reserve(runs.size());
  for (const Run& run : runs) {
    places.push_back(run.variant);
    bytes += disk_bytes(run);
    identity += run_identity(run, kWork) + ' ' + run.variant + '\n';
  }
  agree_on_input(session.options, identity, session.stop);
  const OutputLock lock = claim_directory(directory, places, session.options, bytes);
  const std::string title = runs.front().title;
  const auto formats = runs.front().output;
  Progress progress(session.options.quiet, session.options.json_progress);
  std::vector<design::Report> reports;
  std::vector<OutputLock> locks;  // of the variants: their folders may be named as directories of other runs
  locks.reserve(places.size());
  for (const std::string& name : places) locks.emplace_back(make_subdirectory(directory, name));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto place = directory / places[i];
    const RunContext context{
        session.options,         progress,  session.stop, session.program_arguments, static_cast<std::uint32_t>(i),
        place / kCheckpointName, &locks[i], kWork};
    const auto own_formats = runs[i].output;
    auto made = run_design_job(std::move(runs[i]), context);
    if (!made) {
      progress.line("interrupted: --resume goes on from the last whole step");
      return kInterrupted;
    }
    write_results(place, locks[i], [&] {
      clear_results(place);
      design::write_report(made->report, own_formats, place);
      if (made->write_more) made->write_more();
    });
    print_result(made->report, place);
    reports.push_back(std::move(made->report));
  }
  const design::Comparison comparison = design::compare_reports(title, session.program_arguments, std::move(reports));
  write_results(directory, lock, [&] {
    clear_results(directory);
    design::write_report(comparison, formats, directory);
  });
  for (const design::Report& report : comparison.variants)
    remove_point_checkpoints(directory / report.variant / kCheckpointName);
  print_ratios(comparison);
  fmt::print("files: {}\n", core::one_line(directory.string()));
  return kDone;
}

}  // namespace evenglow::app
