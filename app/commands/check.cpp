#include <algorithm>

#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/run_file.h"
#include "app/tolerance_job.h"

namespace evenglow::app {

namespace {

/// Keeps each fault once: most points of a sweep share those of their file.
void add(std::vector<core::Fault>& faults, const core::ConfigError& error) {
  for (const core::Fault& fault : error.faults()) {
    const auto same = [&](const core::Fault& other) { return other.to_string() == fault.to_string(); };
    if (std::none_of(faults.begin(), faults.end(), same)) faults.push_back(fault);
  }
}

void check_variants(const std::filesystem::path& file, const Options& options) {
  for (const Run& run : read_variants(file, options)) {
    fmt::print("{}{}: good\n", file.string(), run.variant.empty() ? "" : " (variant " + run.variant + ")");
  }
}

/// What `tolerance` looks at before it traces: whether there is what varies, and whether samples can be read.
void check_variations(const std::filesystem::path& file, const Options& options) {
  if (read_run(file, options).tolerance.variations.empty()) return;
  Options own = options;
  own.files = {file};
  const ToleranceJob job = read_tolerance_job(own);
  fmt::print("{}: {} variations are good\n", file.string(), job.nominal.tolerance.variations.size());
}

/// The runs of a batch; what is wrong with some of them is told for each.
void check_sweep(const std::filesystem::path& file, const Options& options, std::vector<core::Fault>& faults) {
  if (core::ConfigDocument::load(file).sweep().empty()) return;
  const std::vector<RunPoint> points = run_points(file);
  std::size_t good = 0;
  for (const RunPoint& point : points) {
    try {
      read_point(file, point, options);
      ++good;
    } catch (const core::ConfigError& error) {
      fmt::print("{} (run {}): wrong\n", file.string(), point.name);
      add(faults, error);
    }
  }
  fmt::print("{}: {} of {} runs of the sweep are good\n", file.string(), good, points.size());
}

}  // namespace

int check_command(const Session& session) {
  std::vector<core::Fault> faults;
  for (const auto& file : session.options.files) {
    try {
      check_variants(file, session.options);
      check_sweep(file, session.options, faults);
      check_variations(file, session.options);
    } catch (const core::ConfigError& error) {
      add(faults, error);
    }
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
  return kDone;
}

}  // namespace evenglow::app
