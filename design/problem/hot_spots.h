#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "design/problem/metrology.h"

/// Do the LEDs of a row show at the edge of the display?
namespace evenglow::design {

/// A window of an LED along its edge, mm.
struct LedWindow {
  double min = 0.0, max = 0.0;
};

/// A row of LEDs at an edge of the plate.
struct LedEdge {
  std::size_t source = 0;  ///< index in the list of sources
  std::string name;        ///< of the edge
  bool along_y = true;     ///< the edge runs along y (left, right), else along x
  double place = 0.0;      ///< of the edge on the other axis, mm
  std::vector<LedWindow> windows;
};

/// Luminance in front of the LEDs over that between them, for each line of cells along the edge, from the batches of
/// the cells' luminance; `unit`: cd/m2 for 1 of the tally. Each gap between neighboring LEDs is held against the mean
/// of the two LEDs beside it, so that a slope along the edge drops out; between them counts the middle of the gap, as
/// wide as an LED at most. A cell counts by the share of it that lies there. The error of the ratio is that of the
/// ratio estimator. None with less than two LEDs in front of the display, with LEDs that leave no gaps, with cells too
/// coarse to tell LEDs and gaps apart, or without light.
///
/// The LEDs do not show where |ratio - 1| is less than 2 % plus two standard errors.
std::optional<HotSpots> hot_spots(const LedEdge& edge, const core::CellGrid& cells, const core::Tally& luminance,
                                  double unit);

}  // namespace evenglow::design
