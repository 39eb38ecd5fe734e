#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace evenglow::tests {

/// What tracing many random run files has shown.
struct SoakOutcome {
  std::uint64_t traced = 0;   ///< files
  std::uint64_t refused = 0;  ///< files that the program would not take, in one line each
  std::uint64_t photons = 0;
  std::vector<std::string> findings;  ///< one line each, with the number of the file
  std::vector<double> pulls;          ///< differences of two seeds over their standard error
  std::vector<std::size_t> resident;  ///< bytes after each file
  double slowest_s = 0.0;

  double pull_mean() const;
  double pull_width() const;
  /// How much the least memory of the last quarter of the files is above that of the second quarter, bytes.
  double growth() const;
};

struct SoakOptions {
  std::uint64_t seed = 1;
  std::uint64_t photons = 8000;  ///< of each trace
  double patience_s = 60.0;      ///< for one file
  std::string kept_file;         ///< where the file at work lies, for crashes; empty: nowhere
  std::function<void(std::uint64_t number, const std::string& yaml, const std::string& finding)> found{};
};

/// Makes random run files and traces each with two seeds, while `go_on(traced files)` holds. A finding is: an exception
/// but for a refusal in one line, an energy account that does not hold all photons, a number that is none, lost
/// photons beyond their bound, a file that takes longer than the patience.
SoakOutcome soak(const SoakOptions& options, const std::function<bool(std::uint64_t)>& go_on);

}  // namespace evenglow::tests
