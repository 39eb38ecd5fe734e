#pragma once

#include <optional>

#include "app/dots_input.h"
#include "core/dots/dot.h"
#include "design/dots/cell_errors.h"
#include "design/dots/discrepancy.h"
#include "design/dots/moire.h"
#include "design/dots/neighbors.h"
#include "design/dots/placement.h"
#include "design/dots/power_spectrum.h"

namespace evenglow::app {

/// How good a pattern is.
struct DotsQuality {
  std::optional<design::CellErrors> cells;  ///< of a pattern with a design
  design::NeighborStatistics neighbors;
  design::DiscrepancyStatistics discrepancy;
  design::PowerSpectrum spectrum;
  std::vector<design::Beat> beats;

  bool has_visible_beat() const;
};

/// The figures of a pattern on this free area; `map`: what it must hold, or null.
DotsQuality judge_dots(const core::DotPattern& dots, const DotsInput& input, const design::FreeArea& free,
                       const design::CoverageMap* map, int threads);

}  // namespace evenglow::app
