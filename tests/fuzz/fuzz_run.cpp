#include "tests/fuzz/fuzz_run.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include "core/base/error.h"
#include "tests/fuzz/mutator.h"

namespace evenglow::tests {
namespace {

std::string& input() {
  static std::string text;
  return text;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

const std::string& current_input() {
  return input();
}

std::string read_one(const FuzzTarget& target, std::string_view bytes, bool& accepted) {
  accepted = false;
  try {
    target.read(bytes);
    accepted = true;
    return "";
  } catch (const core::ConfigError& error) {
    const bool in_lines = std::all_of(error.faults().begin(), error.faults().end(), [](const core::Fault& fault) {
      return fault.to_string().find('\n') == std::string::npos;
    });
    return in_lines ? "" : "a fault of more than one line";
  } catch (const core::Error&) {
    return "";
  } catch (const std::exception& error) {
    return std::string("threw ") + error.what();
  }
}

FuzzOutcome fuzz(const FuzzTarget& target, std::uint64_t seed, double seconds, double patience_s) {
  FuzzOutcome outcome;
  Mutator mutator(seed);
  const auto start = std::chrono::steady_clock::now();
  while (seconds_since(start) < seconds) {
    input() = mutator.next(target.seeds);
    const auto begin = std::chrono::steady_clock::now();
    bool accepted = false;
    outcome.finding = read_one(target, input(), accepted);
    const double taken = seconds_since(begin);
    outcome.slowest_s = std::max(outcome.slowest_s, taken);
    ++outcome.executions;
    outcome.accepted += accepted ? 1 : 0;
    if (outcome.finding.empty() && taken > patience_s) outcome.finding = "took " + std::to_string(taken) + " s";
    if (outcome.finding.empty()) continue;
    outcome.input = input();
    break;
  }
  return outcome;
}

}  // namespace evenglow::tests
