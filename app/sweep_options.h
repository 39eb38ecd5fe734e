#pragma once

#include <string>
#include <vector>

#include "tracer/goniometer/film_sweep.h"

namespace evenglow::app {

/// Values that an option may name, in the unit of the command line.
struct SweepRange {
  double min = 0.0;
  double max = 0.0;
  bool max_open = false;  ///< max itself is not allowed
};

/// Most values of one option.
inline constexpr std::size_t kMostSweepValues = 10'000;

/// `FROM:TO:STEP` (TO included if a step meets it), a number, or numbers parted by commas. Throws `core::ConfigError`
/// that names `option`.
std::vector<double> sweep_values(const std::string& option, const std::string& text, const SweepRange& range);

/// Names out of none, pass, block, 45, right, left, parted by commas, or `all`. Throws `core::ConfigError`.
std::vector<tracer::SweepLight> sweep_lights(const std::string& text);
const char* name_of(tracer::SweepLight light);

/// A whole number in [1, 1e9], also written as 1e5. Throws `core::ConfigError`.
std::uint64_t sweep_photons(const std::string& text);

}  // namespace evenglow::app
