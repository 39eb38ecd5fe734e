#pragma once

#include <cstddef>

#include "core/montecarlo/tally.h"

/// Sums of a luminance receiver with several directions of view, whose bins stand one direction after the other.
namespace evenglow::tracer {

/// What counts, the scores of all directions together: a bin for each of `cells` cells.
core::Tally sum_of_directions(const core::Tally& scores, std::size_t cells);

/// The luminance of one direction alone, in the unit of `sum_of_directions`; `share`: of the direction.
core::Tally one_direction(const core::Tally& scores, std::size_t cells, std::size_t direction, double share);

}  // namespace evenglow::tracer
