#pragma once

#include "core/dots/dot.h"
#include "design/dots/dot_store.h"

namespace evenglow::design {

/// Distances from each dot to its nearest neighbor.
struct NeighborStatistics {
  double least_distance = 0.0;  ///< mm, of two centers
  double mean_distance = 0.0;   ///< mm
  double least_gap = 0.0;       ///< mm between two outlines (circles around square dots); negative: they overlap
  std::size_t overlaps = 0;     ///< dots that overlap another one
  /// Nearest distance over the greatest possible one at the dot's local density (that of the hexagonal lattice,
  /// sqrt(2 / sqrt(3) area)), from the 7 dots around it: 1 hexagonal, 0.93 square, about 0.5 by chance.
  double mean_relative = 0.0;
  double sd_relative = 0.0;
};

/// Of a pattern of at least 2 dots.
NeighborStatistics neighbor_statistics(const DotStore& dots, core::Footprint footprint, int threads);

}  // namespace evenglow::design
