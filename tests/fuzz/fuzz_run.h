#pragma once

#include <cstdint>
#include <filesystem>

#include "tests/fuzz/fuzz_target.h"

namespace evenglow::tests {

struct FuzzOutcome {
  std::uint64_t executions = 0;
  std::uint64_t accepted = 0;  ///< files that the reader took
  std::string finding;         ///< what was thrown or how long it took; empty: nothing
  std::string input;           ///< that did it
  double slowest_s = 0.0;
};

/// Hands damaged files to the target for so many seconds, or until a finding: an exception that is no core::Error, or a
/// file that takes longer than `patience_s`. While a file is read, it lies in `current_input()`, for a handler of
/// signals.
FuzzOutcome fuzz(const FuzzTarget& target, std::uint64_t seed, double seconds, double patience_s);

/// Reads one file as `fuzz` does; what was found, or empty.
std::string read_one(const FuzzTarget& target, std::string_view bytes, bool& accepted);

const std::string& current_input();

}  // namespace evenglow::tests
