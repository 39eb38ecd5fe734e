#include <algorithm>
#include <csignal>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/bench_design.h"
#include "app/commands/commands.h"
#include "app/commands/dots.h"
#include "app/commands/film.h"
#include "app/interrupt.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/rank_role.h"
#include "app/repeating_command.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/config/message_text.h"
#include "core/config/suggestion.h"
#include "core/parallel/ranks.h"

namespace {

using evenglow::app::Options;
using evenglow::app::Session;

struct Command {
  const char* name;
  const char* help;
  const char* example;
  bool many_files;
  bool traces;
  int (*run)(const Session&);
};

constexpr Command kCommands[] = {
    {"check", "read and validate run files; one line for each fault", "evenglow check configs/dbef_vs_lpp.yaml", true,
     false, evenglow::app::check_command},
    {"simulate", "one trace of the backlight as described", "evenglow simulate configs/dbef_vs_lpp.yaml --photons 1e6",
     false, true, evenglow::app::simulate_command},
    {"design", "find the density of the microstructure that makes the display even and bright",
     "evenglow design configs/dbef_vs_lpp.yaml -o out/phone", false, true, evenglow::app::design_command},
    {"compare", "design each variant of a file, or each of several files, and set them side by side",
     "evenglow compare configs/dbef_vs_lpp.yaml", true, true, evenglow::app::compare_command},
    {"pareto", "evenness against efficiency: a design at each of several levels of the density",
     "evenglow pareto configs/phone_dbef.yaml -o out/front", false, true, evenglow::app::pareto_command},
    {"optimize", "turn a few scalar keys (list `optimize` of the file), a design of the density at each point",
     "evenglow optimize configs/studies/phone_optimize.yaml -o out/optimize", false, true,
     evenglow::app::optimize_command},
    {"tolerance", "draw backlights as production makes them: spread of their figures, yield against limits",
     "evenglow tolerance configs/studies/tolerance_phone.yaml --design out/phone_dbef", false, true,
     evenglow::app::tolerance_command},
    {"batch", "design each run of the files: their variants at each point of their sweep; one summary table",
     "evenglow batch configs/*.yaml -o out/overnight", true, true, evenglow::app::batch_command},
    {"paths", "draw the stack in section with the ways of a few photons, colored by their polarization (SVG)",
     "evenglow paths configs/dbef_vs_lpp.yaml -o section.svg", false, false, evenglow::app::paths_command},
    {"trace", "follow one photon: every surface that it meets, its direction and polarization",
     "evenglow trace configs/dbef_vs_lpp.yaml --photon 42", false, false, evenglow::app::trace_command},
};

void add_trace_options(CLI::App& command, Options& options, bool resumes) {
  command.add_option("-o,--out", options.out, "directory for the results (default: out/<name of the file>)")
      ->type_name("DIR");
  command.add_option("--threads", options.threads, "threads (default 0: all; the result does not depend on it)")
      ->check(CLI::Range(0, 4096).description(""))
      ->type_name("N");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
  command.add_flag("--json-progress", options.json_progress, "progress as lines of JSON on stderr, for programs");
  command.add_flag("--overwrite", options.overwrite, "replace a result that is in the directory");
  if (resumes) command.add_flag("--resume", options.resume, "go on with an interrupted run");
}

void add_common_options(CLI::App& command, Options& options, bool many_files) {
  command.add_option("RUN.yaml", options.files, many_files ? "run files" : "run file")
      ->required()
      ->type_name("FILE")
      ->expected(many_files ? -1 : 1);
  command
      .add_option("--set", options.set,
                  "change a key, with its unit in its name: backlight.films[0].axis_deg=90 (may be repeated)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command
      .add_option("--seed", options.seed, "seed of the random numbers (trace.seed; default: that of the file, else 1)")
      ->type_name("N");
  command
      .add_option("--photons", options.photons,
                  "photons of the final trace (trace.photons; default: that of the file, else 20e6)")
      ->type_name("N");
}

void add_paths_options(CLI::App& command, Options& options) {
  command.add_option("-o,--out", options.out, "the picture (default: out/<name of the file>_paths.svg)")
      ->type_name("FILE.svg");
  command.add_flag("--overwrite", options.overwrite, "replace a picture that is there");
  command.add_option("--count", options.path_count, "photons to draw (default 12)")
      ->check(CLI::Range(0, 1000).description(""))
      ->type_name("N");
  command
      .add_option("--window", options.window,
                  "stretch along x that is drawn, mm (default: at the left edge, twelve times as long as high)")
      ->expected(2)
      ->type_name("FROM TO");
}

void add_tolerance_options(CLI::App& command, Options& options) {
  command
      .add_option("--design", options.design,
                  "result of a design whose density is made (tolerance.result; default: what the run file says)")
      ->type_name("DIR");
  command
      .add_option("--sample", options.sample,
                  "replay this sample alone (from 1; 0: the nominal design), with trace.photons and its whole report")
      ->check(CLI::Range(0, 100000).description(""))
      ->type_name("N");
}

void add_photon_options(CLI::App& command, Options& options) {
  command.add_option("--photon", options.photon, "index of the photon within its trace (default 0)")->type_name("N");
  command.add_option("--step", options.step, "design step of the trace (default 0; simulate has no other)")
      ->type_name("N");
  command
      .add_option("--state", options.state,
                  "checkpoint.json of an interrupted design: the photon meets the density of the step that was at work "
                  "(default: the density of the run file)")
      ->type_name("FILE");
  command.add_option("--stream", options.stream, "number of the variant in a comparison, from 0 (default 0)")
      ->type_name("N");
}

void add_schema(CLI::App& program, Options& options, bool& chosen) {
  CLI::App* command =
      program.add_subcommand("schema", "JSON Schema of the run file on stdout: editors complete and check with it");
  command->add_flag("--reference", options.reference, "the keys as tables in Markdown instead");
  command->footer("Example: evenglow schema > evenglow.schema.json");
  command->callback([&chosen] { chosen = true; });
}

/// What is wrong with the first word, if it should be a command and is none; else empty.
std::string unknown_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  std::string listed;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
    listed += (listed.empty() ? "" : ", ") + names.back();
    if (word == names.back()) return "";
  }
  if (word.starts_with("-")) return "";
  const auto meant = evenglow::core::nearest(word, names);
  return "the command must be one of " + listed + "; got " + evenglow::core::shown(word) +
         (meant ? ", did you mean " + *meant + "?" : "");
}

/// Asked for on the command line, which may be wrong elsewhere.
bool wants_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json-progress"; });
}

/// A wrong command line in one line, and where to find the right one.
int refuse(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
  std::string message = argc > 1 ? unknown_command(program, argv[1]) : "";
  std::string help = "evenglow --help";
  if (message.empty()) {
    message = evenglow::core::one_line(error.what());
    if (message == "A subcommand is required") message = "a command is required";
    if (argc > 1 && program.got_subcommand(argv[1])) help = std::string("evenglow ") + argv[1] + " --help";
  }
  evenglow::app::tell("fault", fmt::format("evenglow: {} ({} tells more)", message, help), wants_json(argc, argv));
  return evenglow::app::kWrongInput;
}

int run(int argc, char** argv, evenglow::core::RankGroup& ranks) {
  CLI::App program(
      "Evenglow designs LCD backlights: the density of the microstructure of a light guide plate, by polarized "
      "Monte Carlo. Lengths are mm, angles degrees, flux lm, luminance cd/m2.",
      "evenglow");
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.set_version_flag("--version", "evenglow " + std::string(evenglow::core::version()));
  program.require_subcommand(1);
  program.footer(
      "Example: evenglow compare configs/dbef_vs_lpp.yaml\nExit codes: 0 done, 1 failed, 2 wrong input or usage, 130 "
      "interrupted.");
  Options options;
  const Command* chosen = nullptr;
  for (const Command& command : kCommands) {
    CLI::App* sub = program.add_subcommand(command.name, command.help);
    sub->footer(std::string("Example: ") + command.example);
    add_common_options(*sub, options, command.many_files);
    if (command.traces) add_trace_options(*sub, options, command.run != evenglow::app::simulate_command);
    if (command.run == evenglow::app::batch_command)
      sub->add_flag("--simulate", options.simulate, "one trace of each run instead of a design");
    if (command.run == evenglow::app::tolerance_command) add_tolerance_options(*sub, options);
    if (command.run == evenglow::app::paths_command) add_paths_options(*sub, options);
    if (command.run == evenglow::app::trace_command) add_photon_options(*sub, options);
    sub->callback([&chosen, &command] { chosen = &command; });
  }
  bool schema = false;
  add_schema(program, options, schema);
  evenglow::app::FilmGroup films;
  films.add_to(program);
  evenglow::app::DotsCommand dots;
  dots.add_to(program);
  evenglow::app::BenchDesignCommand bench;
  bench.add_to(program);
  for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; })) command->group("Commands");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return refuse(program, error, argc, argv);
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is told like a full disk, and kills nothing
  const evenglow::app::InterruptGuard interrupt;
  const bool shared = chosen != nullptr && chosen->traces;
  if (ranks.rank() > 0 && !shared) return evenglow::app::kDone;  // rank 0 does it alone
  if (schema) return evenglow::app::schema_command({options, interrupt.token(), "evenglow schema"});
  if (dots.chosen()) return dots.run({options, interrupt.token(), "dots"});
  if (bench.chosen()) return bench.run({options, interrupt.token(), "bench-design"});
  if (films.chosen() != nullptr) return films.chosen()->run({options, interrupt.token(), "film"});
  const std::string repeating = evenglow::app::repeating_command(chosen->name, options);
  if (!shared) return chosen->run({options, interrupt.token(), repeating});
  const bool many = chosen->run == evenglow::app::batch_command;
  const evenglow::app::RankRole role(
      ranks, options,
      many ? evenglow::app::batch_directory(options) : evenglow::app::output_directory(options, options.files.front()),
      interrupt.token());
  return chosen->run({role.options(), interrupt.token(), repeating});
}

/// The exit code; what failed, in `failure`.
int run_told(int argc, char** argv, evenglow::core::RankGroup& ranks, std::string& failure) {
  const bool json = wants_json(argc, argv);
  try {
    return run(argc, argv, ranks);
  } catch (const evenglow::core::ConfigError& error) {
    for (const auto& fault : error.faults()) evenglow::app::tell("fault", fault.to_string(), json);
    failure = error.what();
    return evenglow::app::kWrongInput;
  } catch (const std::bad_alloc&) {
    failure = "not enough memory: fewer cells, a smaller trace.batches or fewer threads take less";
    evenglow::app::tell("failure", "evenglow: " + failure, json);
    return evenglow::app::kFailed;
  } catch (const std::exception& error) {
    evenglow::app::tell("failure", std::string("evenglow: ") + error.what(), json);
    failure = error.what();
    return evenglow::app::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    evenglow::core::RankGroup ranks(evenglow::core::world_link());
    if (ranks.rank() > 0) evenglow::app::keep_quiet();
    std::string failure;
    const int code = run_told(argc, argv, ranks, failure);
    ranks.finish(failure, code);
    return code;
  } catch (const std::exception& error) {
    evenglow::app::tell("failure", std::string("evenglow: ") + error.what(), wants_json(argc, argv));
    return evenglow::app::kFailed;
  }
}
