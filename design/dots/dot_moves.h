#pragma once

#include <vector>

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"

namespace evenglow::design {

/// New places of all dots, made while the old ones stand.
struct DotMoves {
  std::vector<double> x, y;

  explicit DotMoves(std::size_t count) : x(count), y(count) {}
};

/// Moves a dot to (x + dx, y + dy), or along x or y alone if it would not lie whole in the free area there, else not.
void move_free(const DotSpec& spec, const CoverageMap& map, double dx, double dy, float diameter, double& x, double& y);

/// The same for a dot that must stay in its cell: it goes at most half of its way to the border.
void move_within(const DotSpec& spec, const CoverageMap& map, std::size_t cell, double dx, double dy, float diameter,
                 double& x, double& y);

}  // namespace evenglow::design
