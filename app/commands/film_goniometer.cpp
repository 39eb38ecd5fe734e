#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/goniometer_pictures.h"
#include "app/goniometer_text.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/repeating_command.h"
#include "app/run_file.h"
#include "app/text_output.h"
#include "core/base/sha256.h"
#include "tracer/goniometer/goniometer.h"

namespace evenglow::app {
namespace {

/// A goniometer run, read and checked.
struct GoniometerRun {
  tracer::GoniometerSpec spec;
  tracer::TraceSpec trace;
  GoniometerFacts facts;
};

GoniometerRun read_run_file(const std::filesystem::path& file, const Options& options) {
  core::ConfigDocument document = core::ConfigDocument::load(file);
  for (const auto& change : option_overrides(options)) document.apply(change);
  const core::ConfigNode root = document.root();
  root.integer({"evenglow", "version of this format, 1", 1, 1, {}});
  GoniometerRun run;
  run.facts.title = root.text({"title", "one line for the report", document.name()});
  run.spec = tracer::read_goniometer(root.map("goniometer", "film, lamp, filter and detector", true));
  run.trace = tracer::read_photons(root.map("trace", "photons of each setting of film and filter"));
  document.finish();
  run.facts.command = repeating_command("film goniometer", options);
  run.facts.run_file_sha256 = core::sha256_hex(document.source_text());
  run.facts.seed = run.trace.seed;
  run.facts.photons_per_setting = run.trace.photons;
  return run;
}

class FilmGoniometer final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command.add_option("RUN.yaml", options_.files, "run file with the key goniometer (docs/goniometer.md)")
        ->required()
        ->type_name("FILE")
        ->expected(1);
    command.add_option("-o,--out", options_.out, "directory for the results (default: out/<name of the file>)")
        ->type_name("DIR");
    command.add_option("--set", options_.set, "change a key: goniometer.detector.acceptance_deg=1 (may be repeated)")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
    command.add_option("--seed", options_.seed, "seed of the random numbers (trace.seed)")->type_name("N");
    command.add_option("--photons", options_.photons, "photons of each setting of film and filter (trace.photons)")
        ->type_name("N");
    command.add_option("--threads", options_.threads, "threads (default 0: all; the result does not depend on it)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_flag("--no-trace", no_trace_, "evaluate only, trace no photons");
    command.add_flag("--quiet", options_.quiet, "no progress on stderr");
    command.add_flag("--overwrite", options_.overwrite, "replace a result that is in the directory");
  }

  int run(const Session& session) override {
    const auto& file = options_.files.front();
    GoniometerRun run = read_run_file(file, options_);
    const auto directory = output_directory(options_, file);
    check_free(directory, {}, options_);
    if (!options_.overwrite) {
      require_free({directory / "goniometer.json", directory / "reflection.csv", directory / "transmission.csv",
                    directory / "bsdf.png", directory / "reflection.png", directory / "transmission.png"});
    }
    make_directory(directory);
    const auto result = measured(run, session);
    if (!result) return kInterrupted;
    if (no_trace_) run.facts.photons_per_setting = 0;
    write_whole(directory / "reflection.csv", goniometer_csv(run.spec, *result, tracer::ScatterKind::reflection));
    write_whole(directory / "transmission.csv", goniometer_csv(run.spec, *result, tracer::ScatterKind::transmission));
    write_goniometer_pictures(run.spec, *result, directory);
    write_whole(directory / "goniometer.json", goniometer_json(run.spec, *result, run.facts));
    fmt::print("{}results: {}\n", goniometer_summary(run.spec, *result), directory.string());
    return kDone;
  }

 private:
  std::optional<tracer::GoniometerResult> measured(const GoniometerRun& run, const Session& session) const {
    Progress progress(options_.quiet);
    const std::uint64_t all = run.trace.photons * tracer::traced_settings(run.spec);
    tracer::GoniometerTrace trace;
    trace.photons = no_trace_ ? 0 : run.trace.photons;
    trace.batches = run.trace.batches;
    trace.seed = run.trace.seed;
    trace.threads = options_.threads;
    trace.stop = session.stop;
    trace.progress = [&](std::uint64_t done) { progress.photons(done, all); };
    progress.begin("goniometer");
    auto result = tracer::measure(run.spec, trace);
    if (!result) progress.line("interrupted: nothing was written");
    return result;
  }

  Options options_;
  bool no_trace_ = false;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_goniometer() {
  return std::make_unique<FilmGoniometer>();
}

}  // namespace evenglow::app
