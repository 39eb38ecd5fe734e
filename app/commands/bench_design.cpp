#include "app/commands/bench_design.h"

#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "app/backlight_run.h"
#include "app/bench_report.h"
#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/repeating_command.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/design_start.h"
#include "design/updaters/updater.h"

namespace evenglow::app {
namespace {

const std::vector<double> kThresholds = {0.05, 0.02, 0.01, 0.005};
constexpr const char* kSmallCase = "configs/studies/bench_design.yaml";
constexpr const char* kFullCases[] = {"configs/phone_dbef.yaml", "configs/phone_lpp.yaml", "configs/tablet_dbef.yaml"};

/// Behind the name of an updater: luminance by counting photons, as other programs do.
constexpr const char* kCounting = "/counting";
/// More photons of counting, for it learns less from each.
constexpr std::uint64_t kCountingPhotons = 32;

bool is_counting(const std::string& name) {
  return name.ends_with(kCounting);
}

std::string updater_of(const std::string& name) {
  return is_counting(name) ? name.substr(0, name.size() - std::string(kCounting).size()) : name;
}

std::vector<std::string> updater_names(const std::vector<std::string>& wanted) {
  std::vector<std::string> known;
  for (const auto& entry : design::updater_registry()) known.push_back(entry.name);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), updater_of(name)) == known.end()) {
      throw core::ConfigError(core::Fault{"--updaters", 0, 0, "",
                                          fmt::format("must be among {}, each also with {} behind it, got {}",
                                                      fmt::join(known, ", "), kCounting, name)});
    }
  }
  if (!wanted.empty()) return wanted;
  known.push_back(std::string("ratio") + kCounting);
  return known;
}

/// The level is fixed, that of the start: all updaters solve one problem. Searches get as many steps as they need.
design::DesignSpec bench_spec(const design::DesignSpec& given, const std::string& updater, double level) {
  design::DesignSpec spec = given;
  spec.goal = {};
  spec.updater = updater;
  if (!spec.level) spec.level = level;
  spec.stop_rms = kThresholds.back();
  spec.max_steps = updater == "spline" ? std::max(60, given.max_steps) : std::max(20, given.max_steps);
  return spec;
}

struct BenchSettings {
  std::vector<std::string> updaters;
  int seeds;
  double cpu_s;
  const Session& session;
  Progress& progress;
};

/// Empty: interrupted.
std::optional<BenchCase> run_case(const std::filesystem::path& file, const Options& options,
                                  const BenchSettings& settings) {
  Run run = read_run(file, options, Purpose::kDesign);
  const RunContext context{options, settings.progress, settings.session.stop, "bench-design"};
  const tracer::DensityField start = design::first_density(run.backlight, run.design);
  const design::DesignLimits limits = design_limits(run);
  BenchCase bench{file.stem().string(), run.title, run.backlight.luminance.cells.size(), {}};
  Run counted = read_run(file, options, Purpose::kDesign);
  counted.backlight.luminance.estimator = tracer::LuminanceEstimator::kCounting;
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const tracer::Scene counting = tracer::compile_scene(std::move(counted.backlight));
  const std::uint64_t first_seed = run.trace.seed;
  for (const std::string& updater : settings.updaters) {
    for (int i = 0; i < settings.seeds; ++i) {
      run.trace.seed = first_seed + static_cast<std::uint64_t>(i);
      settings.progress.begin(fmt::format("{}: {}, seed {}", bench.name, updater, run.trace.seed));
      const design::ForwardModel model = make_model(is_counting(updater) ? counting : scene, run, context);
      const design::ForwardModel judge = make_model(scene, run, context);
      design::TrialLimits trial_limits{limits, settings.cpu_s, limits.largest_photons, &judge};
      if (is_counting(updater)) trial_limits.largest_photons *= kCountingPhotons;
      const design::DesignSpec spec = bench_spec(run.design, updater_of(updater), start.cells.mean());
      auto trial = run_trial(model, spec, trial_limits, start, kThresholds);
      if (!trial) return std::nullopt;
      trial->seed = run.trace.seed;
      trial->updater = updater;
      settings.progress.line(fmt::format("{}: {}, seed {}: {} steps, {:.3g} CPU s, RMS {:.2f} +- {:.2f} %", bench.name,
                                         updater, run.trace.seed, trial->steps.size(), trial->cpu_s.back(),
                                         100.0 * trial->judged.rms_corrected.value,
                                         100.0 * trial->judged.rms_corrected.se));
      bench.trials.push_back(std::move(*trial));
    }
  }
  return bench;
}

}  // namespace

void BenchDesignCommand::add_to(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "bench-design", "how fast each updater of the design reaches 5, 2, 1 and 0.5 %: steps, photons, CPU seconds");
  command->add_option("RUN.yaml", options_.files, "run files (default: a small phone, " + std::string(kSmallCase) + ")")
      ->type_name("FILE");
  command->add_option("-o,--out", options_.out, "directory for the results (default: out/bench_design)")
      ->type_name("DIR");
  command->add_option("--seeds", seeds_, "designs with each updater, each with a seed of its own (default 5)")
      ->check(CLI::Range(1, 1000).description(""))
      ->type_name("N");
  command
      ->add_option("--cpu", cpu_s_, "CPU seconds after which a design begins no other trace (default 600; 0: no limit)")
      ->check(CLI::Range(0.0, 1e9).description(""))
      ->type_name("SECONDS");
  command
      ->add_option("--updaters", updaters_,
                   "updaters, parted by commas; with /counting behind it: on counted photons (default: all, and "
                   "ratio/counting)")
      ->delimiter(',')
      ->type_name("NAMES");
  command->add_flag("--full", full_, "the shipped phone and tablet files in full size instead of the small case");
  command->add_option("--set", options_.set, "change a key of the run files (may be repeated)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command->add_option("--photons", options_.photons, "photons of the largest step (trace.photons)")->type_name("N");
  command->add_option("--threads", options_.threads, "threads (default 0: all)")
      ->check(CLI::Range(0, 4096).description(""))
      ->type_name("N");
  command->add_flag("--quiet", options_.quiet, "no progress on stderr");
  command->add_flag("--overwrite", options_.overwrite, "replace a result that is in the directory");
  command->footer("Example: evenglow bench-design --seeds 5 -o out/bench");
  command->callback([this] { chosen_ = true; });
}

int BenchDesignCommand::run(const Session& session) {
  const BenchFacts facts{repeating_command("bench-design", options_) + fmt::format(" --seeds {}", seeds_) +
                             (full_ ? " --full" : "") + fmt::format(" --cpu {:g}", cpu_s_) +
                             (updaters_.empty() ? "" : fmt::format(" --updaters {}", fmt::join(updaters_, ","))),
                         kThresholds, updater_names(updaters_)};
  std::vector<std::filesystem::path> files = options_.files;
  if (files.empty() && full_) files.assign(std::begin(kFullCases), std::end(kFullCases));
  if (files.empty()) {
    std::error_code ignored;
    if (!std::filesystem::exists(kSmallCase, ignored)) {
      throw core::ConfigError(
          core::Fault{"bench-design", 0, 0, "",
                      fmt::format("must be given a run file where there is no {}, got none", kSmallCase)});
    }
    files = {kSmallCase};
  }
  const std::filesystem::path directory =
      options_.out.empty() ? std::filesystem::path("out/bench_design") : options_.out;
  for (const auto& file : files) read_run(file, options_, Purpose::kDesign);  // all faults before the first photon
  check_free(directory, {}, options_);
  make_directory(directory);
  Progress progress(options_.quiet, options_.json_progress);
  std::vector<BenchCase> cases;
  for (const auto& file : files) {
    auto bench = run_case(file, options_, {facts.updaters, seeds_, cpu_s_, session, progress});
    if (!bench) {
      progress.line("interrupted: nothing was written");
      return kInterrupted;
    }
    cases.push_back(std::move(*bench));
  }
  clear_results(directory);
  const design::Study study = bench_study(facts, cases);
  write_bench(study, facts, cases, directory);
  fmt::print("{}files: {}\n", design::study_text(study), core::one_line(directory.string()));
  return kDone;
}

}  // namespace evenglow::app
