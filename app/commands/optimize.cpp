#include <fmt/core.h>

#include "app/backlight_run.h"
#include "app/commands/commands.h"
#include "app/optimize_report.h"
#include "app/output_directory.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/design_start.h"
#include "design/engine/state_file.h"
#include "design/engine/traced_model.h"
#include "design/report/csv_writer.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "tracer/scene/refined_density.h"

namespace evenglow::app {
namespace {

constexpr const char* kWork = "optimize";
constexpr std::uint32_t kVerdictStep = design::kJudgingStep - 5000U;  // random numbers of the last judgment

/// The run at a point: the user's changes, then the keys of the search.
Run run_at(const Session& session, const design::OuterSpec& outer, const std::vector<double>& values) {
  Options options = session.options;
  for (std::size_t i = 0; i < values.size(); ++i)
    options.set.push_back(outer.variables[i].key + "=" + design::shortest(values[i]));
  return read_run(session.options.files.front(), options, Purpose::kDesign);
}

/// All faults of the ranges' ends, and of the start, before the first photon.
void check_ranges(const Session& session, const design::OuterSpec& outer) {
  for (const double design::OuterVariable::*end :
       {&design::OuterVariable::start, &design::OuterVariable::low, &design::OuterVariable::high}) {
    std::vector<double> values;
    values.reserve(outer.variables.size());
    for (const auto& v : outer.variables) values.push_back(v.*end);
    run_at(session, outer, values);
  }
}

/// Every design reads the files anew: after each reading, they must be what they were at the start, or the search would
/// compare designs of different backlights. (Files are hashed after they are read: a change before or while they are
/// read shows.)
void check_unchanged(const Session& session, const std::string& identity) {
  const auto& file = session.options.files.front();
  if (run_identity(read_run(file, session.options, Purpose::kDesign), kWork) == identity) return;
  throw core::ConfigError(core::Fault{core::one_line(file.string()), 0, 0, "",
                                      "must stay as it was until the search has ended, with all files that it names, "
                                      "got a change (--overwrite begins anew)"});
}

struct Designed {
  design::OuterResult result;
  core::CellField density;
};

/// A design at these values, judged with the random numbers of `judging_step`. Empty: interrupted.
std::optional<Designed> design_at(const Session& session, const design::OuterSpec& outer,
                                  const std::vector<double>& values, std::uint32_t judging_step, Progress& progress,
                                  const std::string& identity) {
  Run run = run_at(session, outer, values);
  check_unchanged(session, identity);
  const RunContext context{session.options, progress, session.stop, ""};
  const design::DesignLimits limits = design_limits(run);
  design::DesignProgress state =
      design::start_design(design::first_density(run.backlight, run.design), run.design, limits);
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const design::ForwardModel model = make_model(scene, run, context);
  state = run_design(model, run.design, limits, std::move(state), [](const auto&, const auto&) {});
  if (state.stop_reason.empty()) return std::nullopt;
  const auto judging = model(state.best_density, run.trace.photons, judging_step);
  if (!judging) return std::nullopt;
  const design::FinalJudgment judged = make_judgment(*judging, run.design);
  Designed designed{{values, judged.efficiency, judged.rms_corrected, judging->photons, judging->cpu_s},
                    tracer::traced_density(scene.spec, state.best_density).cells};
  for (const design::StepRecord& step : state.steps) {
    designed.result.photons += step.photons + step.level_photons;
    designed.result.cpu_s += step.cpu_s;
  }
  return designed;
}

/// A state may come from anyone.
void check_within(const design::OuterSpec& outer, const design::OuterResult& result) {
  bool good = result.values.size() == outer.variables.size();
  for (std::size_t i = 0; good && i < result.values.size(); ++i) {
    const design::OuterVariable& v = outer.variables[i];
    const double rounding = (v.whole ? 0.5 : 0.0) + 1e-9 * (v.high - v.low);
    good = result.values[i] >= v.low - rounding && result.values[i] <= v.high + rounding;
  }
  if (!good) throw core::Error("the checkpoint cannot be used (a design of it leaves the ranges of the run file)");
}

std::vector<design::OuterResult> earlier_results(const Session& session, const design::OuterSpec& outer,
                                                 const std::filesystem::path& state, const std::string& identity,
                                                 Progress& progress) {
  if (!session.options.resume) {
    design::remove_state(state);  // of a search that is begun anew
    return {};
  }
  try {
    std::string note;
    auto results = read_optimize_state(state, identity, note);
    if (!note.empty()) progress.line(note);
    for (const design::OuterResult& result : results) check_within(outer, result);
    return results;
  } catch (const core::Error& error) {
    throw core::ConfigError(
        core::Fault{"--resume", 0, 0, "", core::one_line(error.what()) + " (--overwrite begins anew)"});
  }
}

std::string told(const design::OuterSpec& outer, std::size_t number, const design::OuterResult& r) {
  std::string text = fmt::format("design {}:", number);
  for (std::size_t i = 0; i < r.values.size(); ++i)
    text += fmt::format(" {} {:.4g},", outer.variables[i].key, r.values[i]);
  return text + fmt::format(" efficiency {:.2f} +- {:.2f} %, RMS {:.2f} +- {:.2f} %", 100.0 * r.efficiency.value,
                            100.0 * r.efficiency.se, 100.0 * r.rms.value, 100.0 * r.rms.se);
}

}  // namespace

int optimize_command(const Session& session) {
  const auto& file = session.options.files.front();
  const Run run = read_run(file, session.options, Purpose::kDesign);
  if (run.outer.variables.empty()) {
    throw core::ConfigError(core::Fault{file.string(), 0, 0, "optimize",
                                        "must be a list of {key: PATH, range: [least, largest]}, got nothing"});
  }
  check_ranges(session, run.outer);
  const std::string identity = run_identity(run, kWork);
  agree_on_input(session.options, identity, session.stop);
  const auto directory = output_directory(session.options, file);
  const OutputLock lock = claim_directory(directory, {}, session.options, disk_bytes(run));
  Progress progress(session.options.quiet, session.options.json_progress);
  const std::filesystem::path state = directory / kCheckpointName;
  const design::OuterModel model = [&](const std::vector<double>& values) -> std::optional<design::OuterResult> {
    auto designed = design_at(session, run.outer, values, design::kJudgingStep, progress, identity);
    return designed ? std::optional(std::move(designed->result)) : std::nullopt;
  };
  const auto observer = [&](const std::vector<design::OuterResult>& results) {
    progress.line(told(run.outer, results.size() - 1, results.back()));
    lock.check();
    design::save_state(state, optimize_state(identity, results));
    progress.begin(fmt::format("design {}", results.size()));
  };
  progress.begin("design 0");
  const auto interrupted = [&] {
    progress.line("interrupted: --resume goes on from the last whole design");
    return kInterrupted;
  };
  const auto results =
      design::run_outer(model, run.outer, earlier_results(session, run.outer, state, identity, progress), observer);
  if (!results) return interrupted();
  OptimizeVerdict verdict = choose_design(*results, run.outer.rms);
  progress.begin(verdict.feasible ? "start and best once more" : "start and nearest once more");
  const auto start = design_at(session, run.outer, results->front().values, kVerdictStep, progress, identity);
  const auto best =
      start ? design_at(session, run.outer, (*results)[verdict.best].values, kVerdictStep - 1U, progress, identity)
            : std::nullopt;
  if (!best) return interrupted();
  verdict.start = start->result;
  verdict.improved = best->result;
  const design::Study study = optimize_study(run, session.program_arguments, *results, verdict);
  write_results(directory, lock, [&] {
    clear_results(directory);
    write_optimize(study, run, *results, verdict, directory);
    const std::string title = "density of the microstructure (share of the cell's area, 1)";
    design::write_file(directory / "density.csv", design::matrix_csv(best->density, title));
  });
  design::remove_state(state);
  fmt::print("{}\n{}{}\nfiles: {}\n", core::one_line(study.title), design::study_text(study), study.notes.front(),
             core::one_line(directory.string()));
  return kDone;
}

}  // namespace evenglow::app
