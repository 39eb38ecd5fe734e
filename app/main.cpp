#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/interrupt.h"
#include "core/base/error.h"
#include "core/base/version.h"

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
    {"check", "read and validate run files; one line for each fault", "evenglow check configs/phone_dbef.yaml", true, false,
     evenglow::app::check_command},
    {"simulate", "one trace of the backlight as described", "evenglow simulate configs/phone_dbef.yaml --photons 1e6", false,
     true, evenglow::app::simulate_command},
    {"design", "find the density of the microstructure that makes the display even and bright",
     "evenglow design configs/phone_dbef.yaml -o out/phone", false, true, evenglow::app::design_command},
    {"compare", "design each variant of a file, or each of several files, and set them side by side",
     "evenglow compare configs/dbef_vs_lpp.yaml", true, true, evenglow::app::compare_command},
};

void add_trace_options(CLI::App& command, Options& options, bool resumes) {
  command.add_option("-o,--out", options.out, "directory for the results (default: out/<name of the file>)");
  command.add_option("--threads", options.threads, "threads (default 0: all; the result does not depend on it)")
      ->check(CLI::Range(0, 4096));
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
  command.add_flag("--overwrite", options.overwrite, "replace a result that is in the directory");
  if (resumes) command.add_flag("--resume", options.resume, "go on with an interrupted run");
}

void add_common_options(CLI::App& command, Options& options, bool many_files) {
  command.add_option("RUN.yaml", options.files, many_files ? "run files" : "run file")->required()->expected(1, many_files ? 1000 : 1);
  command.add_option("--set", options.set, "change a key: path.to.key=value (may be repeated)")->expected(1)->take_all();
  command.add_option("--seed", options.seed, "seed of the random numbers (trace.seed)");
  command.add_option("--photons", options.photons, "photons of the final trace (trace.photons), e.g. 20e6");
}

std::string quoted(const std::string& word) {
  if (word.find_first_of(" \t\n'\"\\$&|;<>(){}[]*?#~`!") == std::string::npos && !word.empty()) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The command that repeats a result: the words that change it.
std::string repeating_command(const std::string& command, const Options& options) {
  std::string text = "evenglow " + command;
  for (const auto& file : options.files) text += ' ' + quoted(file.string());
  for (const std::string& change : options.set) text += " --set " + quoted(change);
  if (options.seed) text += " --seed " + std::to_string(*options.seed);
  if (options.photons) text += " --photons " + quoted(*options.photons);
  return text;
}

int run(int argc, char** argv) {
  CLI::App program("Evenglow designs LCD backlights: the density of the microstructure of a light guide plate, by polarized "
                   "Monte Carlo. Lengths are mm, angles degrees, flux lm, luminance cd/m2.");
  program.set_version_flag("--version", "evenglow " + std::string(evenglow::core::version()));
  program.require_subcommand(1);
  program.footer("Example: evenglow compare configs/dbef_vs_lpp.yaml\nExit codes: 0 done, 1 failed, 2 wrong input or usage, 130 interrupted.");
  Options options;
  const Command* chosen = nullptr;
  for (const Command& command : kCommands) {
    CLI::App* sub = program.add_subcommand(command.name, command.help);
    sub->footer(std::string("Example: ") + command.example);
    add_common_options(*sub, options, command.many_files);
    if (command.traces) add_trace_options(*sub, options, command.run != evenglow::app::simulate_command);
    sub->callback([&chosen, &command] { chosen = &command; });
  }
  evenglow::app::FilmGroup films;
  films.add_to(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "evenglow: {}\n", error.what());
    return evenglow::app::kWrongInput;
  }
  const evenglow::app::InterruptGuard interrupt;
  if (films.chosen() != nullptr) return films.chosen()->run({options, interrupt.token(), "film"});
  return chosen->run({options, interrupt.token(), repeating_command(chosen->name, options)});
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const evenglow::core::ConfigError& error) {
    for (const auto& fault : error.faults()) fmt::print(stderr, "{}\n", fault.to_string());
    return evenglow::app::kWrongInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "evenglow: {}\n", error.what());
    return evenglow::app::kFailed;
  }
}
