#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/dots_input.h"
#include "app/progress.h"
#include "design/dots/coverage_map.h"
#include "design/dots/keep_out.h"
#include "design/dots/placement.h"

namespace evenglow::app {

/// Seconds from lap to lap.
class LapWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The files of a pattern.
inline constexpr std::array<const char*, 9> kDotFiles = {"dots.json",     "dots.csv",          "dots.dxf",
                                                         "dots.gds",      "dots.svg",          "dots.png",
                                                         "dots_zoom.png", "dots_spectrum.png", "dots_made.csv"};

/// A pattern that is to be judged and written.
struct DotsOutput {
  const DotsInput& input;
  const design::FreeArea& free;
  const design::CoverageMap* map = nullptr;  ///< what it must hold; null: of an imported one
  const design::Placement& placement;
  std::string source;       ///< result directory or pattern file
  std::size_t ignored = 0;  ///< entities of a drawing that are no dots
  double placement_s = 0.0, placement_cpu_s = 0.0;
  std::stop_token stop{};
};

/// The part of the plate where dots may be. Throws ConfigError if that is none.
design::FreeArea free_area(const DotsInput& input);

/// What the user is told of it.
struct DotsTold {
  std::string table;
  std::vector<std::string> warnings;
};

/// Works out the figures of quality and writes all files into the directory, which is made if it is not there; earlier
/// ones are replaced, once the disk has shown that it has room for the new ones. `threads` 0: all. Empty: a stop was
/// asked for before a file was touched.
std::optional<DotsTold> write_dots(const DotsOutput& output, const std::filesystem::path& directory, Progress& progress,
                                   int threads);

}  // namespace evenglow::app
