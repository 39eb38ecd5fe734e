#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace evenglow::bench {

/// One line of the table: a counter of a benchmark and the bar that it is held against.
struct Line {
  std::string what;
  std::string benchmark;  ///< its name up to the first '/'
  std::string counter;
  std::string unit;
  std::optional<double> at_most{};
  std::optional<double> at_least{};
};

/// All lines, in the order of the table; docs/performance.md tells what each means.
const std::vector<Line>& lines();

/// Values of the repetitions, by benchmark and counter.
using Measurements = std::map<std::pair<std::string, std::string>, std::vector<double>>;

/// Medians beside their bars, as text and as JSON; lines that were not measured are left out.
std::string table_text(const Measurements& measurements);
std::string table_json(const Measurements& measurements);

}  // namespace evenglow::bench
