#pragma once

#include <cstddef>
#include <stop_token>

#include "core/dots/dot.h"
#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"

namespace evenglow::design {

/// Dots made from a density.
struct Placement {
  core::DotPattern dots;        ///< cell by cell; places whole nm, diameters whole size steps (of one size: as given)
  std::size_t removed = 0;      ///< that found no place with the least gap
  std::size_t short_cells = 0;  ///< wholly free cells whose density the limits do not allow (accept_shortfall)
  double wanted_area = 0.0;     ///< mm2 under dots
  double area = 0.0;            ///< mm2 of the dots placed
};

/// Densest the blue-noise modes pack: share of the area under circles of diameter + gap. Measured at an even density:
/// at 0.68 every dot finds its place, at 0.72 one in 700 does not.
inline constexpr double kDensestPacking = 0.67;

/// Most that a mode can hold of a cell: share of its area under footprints, for dots of this coverage's size.
double greatest_coverage(const DotSpec& spec, double diameter);

/// Places the dots. Each cell holds its coverage times its free area within one dot; dots are nowhere nearer than the
/// gap; every dot lies whole within the free area. Same seed, same dots, on any number of `threads` (0: all). Throws
/// ConfigError if a cell asks for more than the limits allow, unless `accept_shortfall`; if nothing is to be placed; if
/// more than 50 million dots would be. After a stop was asked for it comes back soon, with a pattern that is not done:
/// the caller looks at the token.
Placement place_dots(const DotSpec& spec, const CoverageMap& map, int threads, const std::stop_token& stop = {});

}  // namespace evenglow::design
