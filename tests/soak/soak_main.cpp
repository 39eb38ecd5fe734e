#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>

#include <fmt/core.h>

#include "tests/soak/soak.h"
#include "tests/support/temp_folder.h"

/// evenglow_soak [MINUTES [SEED]]   traces random run files; findings are left in soak-finding-NUMBER.yaml
int main(int argc, char** argv) {
  using namespace evenglow::tests;
  const double minutes = argc > 1 ? std::strtod(argv[1], nullptr) : 30.0;
  SoakOptions options;
  options.seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  options.kept_file = "soak-at-work.yaml";
  options.found = [](std::uint64_t number, const std::string& yaml, const std::string& finding) {
    fmt::print("file {}: {}\n", number, finding);
    std::fflush(stdout);
    write_text("soak-finding-" + std::to_string(number) + ".yaml", yaml);
  };
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60.0;
  };
  const SoakOutcome outcome = soak(options, [&](std::uint64_t traced) { return elapsed() < minutes || traced < 1; });
  std::remove(options.kept_file.c_str());
  const double pulls = static_cast<double>(outcome.pulls.size());
  const std::size_t last = outcome.resident.back();
  fmt::print("{} files traced, {} refused, {:.3g} photons, {:.1f} minutes, slowest {:.1f} s\n", outcome.traced,
             outcome.refused, static_cast<double>(outcome.photons), elapsed(), outcome.slowest_s);
  fmt::print("pulls: {}, mean {:.3f} +- {:.3f}, width {:.3f} (expected 1.03 +- {:.3f}: 19 and 19 degrees of freedom)\n",
             outcome.pulls.size(), outcome.pull_mean(), 1.0 / std::sqrt(pulls), outcome.pull_width(),
             1.0 / std::sqrt(2.0 * pulls));
  fmt::print("memory: {:.1f} MiB at the end, {:+.1f} MiB from the second to the last quarter\n",
             static_cast<double>(last) / 1048576.0, outcome.growth() / 1048576.0);
  // Wide bounds: 5 standard errors, and what an allocator may keep.
  const bool pulls_good = std::abs(outcome.pull_mean()) < 5.0 / std::sqrt(pulls) &&
                          std::abs(outcome.pull_width() - 1.03) < 0.03 + 5.0 / std::sqrt(2.0 * pulls);
  const bool flat = outcome.growth() < 32.0 * 1048576.0;
  fmt::print("{} findings{}{}\n", outcome.findings.size(), pulls_good ? "" : "; THE ERROR BARS ARE WRONG",
             flat ? "" : "; THE MEMORY GROWS");
  return outcome.findings.empty() && pulls_good && flat ? 0 : 1;
}
