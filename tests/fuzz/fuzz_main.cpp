#include <csignal>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include "tests/fuzz/fuzz_run.h"
#include "tests/support/temp_folder.h"

/// evenglow_fuzz TARGET|all [SECONDS [SEED]]   damages files and hands them to readers
/// evenglow_fuzz TARGET FILE                   reads one file, as a finding left it
namespace {

using namespace evenglow::tests;

constexpr double kPatience = 20.0;  // s for one file, under sanitizers on a busy machine
constexpr const char* kLeftInput = "fuzz-finding";

/// Leaves the input that ended the program; only calls that a handler of signals may make.
void leave_input(int signal) {
  const int out = ::open(kLeftInput, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (out >= 0) [[maybe_unused]]
    const ssize_t written = ::write(out, current_input().data(), current_input().size());
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

int fuzz_one(const FuzzTarget& target, double seconds, std::uint64_t seed) {
  const FuzzOutcome outcome = fuzz(target, seed, seconds, kPatience);
  fmt::print("{:<16} {:>9} files, {:>8} accepted, slowest {:.3f} s, {}\n", target.name, outcome.executions,
             outcome.accepted, outcome.slowest_s, outcome.finding.empty() ? "no finding" : outcome.finding);
  std::fflush(stdout);
  if (outcome.finding.empty()) return 0;
  write_text(std::string(kLeftInput) + "-" + target.name, outcome.input);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, leave_input);
  const std::string chosen = argc > 1 ? argv[1] : "all";
  const std::string second = argc > 2 ? argv[2] : "60";
  int findings = 0;
  bool found = false;
  for (const FuzzTarget& target : fuzz_targets()) {
    if (chosen != "all" && chosen != target.name) continue;
    found = true;
    char* end = nullptr;
    const double seconds = std::strtod(second.c_str(), &end);
    if (*end == '\0') {
      findings += fuzz_one(target, seconds, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
      continue;
    }
    bool accepted = false;
    const std::string finding = read_one(target, file_text(second), accepted);
    fmt::print("{}: {}\n", target.name, !finding.empty() ? finding : accepted ? "accepted" : "refused");
    findings += finding.empty() ? 0 : 1;
  }
  if (!found) fmt::print(stderr, "no target {}\n", chosen);
  return found && findings == 0 ? 0 : 1;
}
