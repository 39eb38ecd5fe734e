#pragma once

#include <cstddef>
#include <functional>

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"
#include "design/dots/size_law.h"

namespace evenglow::design {

/// How many dots of its size each cell's area asks for.
core::CellField wanted_counts(const CoverageMap& map, const SizeLaw& law);

/// As many dots in each cell as its area asks for (`whole_counts`), each somewhere in its cell with odds that follow
/// the coverage, whole within the free area. Where a free area is too small for the dots of its cell, fewer are set.
/// A cell's numbers depend on the seed and its index.
DotStore start_dots(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law, int threads);

/// Cells are worked on in chunks of this many; calls `work(cell)` for each, on `threads` threads.
void for_each_cell(std::size_t cells, int threads, const std::function<void(std::size_t)>& work);

}  // namespace evenglow::design
