#pragma once

#include <string>

#include "app/dots_input.h"
#include "app/dots_quality.h"
#include "design/dots/placement.h"

namespace evenglow::app {

/// What a run of `evenglow dots` has to tell.
struct DotsReport {
  const DotsInput& input;
  const design::Placement& placement;  ///< of an imported pattern: its dots and their area
  const DotsQuality& quality;
  std::string source;       ///< result directory or pattern file
  std::size_t ignored = 0;  ///< entities of a drawing that are no dots
  /// Of the dots as the process makes them, if it changes them.
  std::optional<design::NeighborStatistics> made_neighbors{};
  double made_area = 0.0;  ///< mm2
  double placement_s = 0.0, placement_cpu_s = 0.0, quality_s = 0.0, files_s = 0.0;
};

/// dots.json
std::string dots_json(const DotsReport& report);
/// The short table for stdout.
std::string dots_table(const DotsReport& report);
/// Visible beats and other reasons to look twice, one line each.
std::vector<std::string> dots_warnings(const DotsReport& report);

}  // namespace evenglow::app
