#pragma once

#include <vector>

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"

namespace evenglow::design {

/// Brings the number of dots of every cell within one of `wanted` (whole or not) after dots have wandered: a cell with
/// too many passes the dot nearest to a border on to the next cell, that one in turn another, on the shortest way to a
/// cell that may have one more; a cell with too few is given one in the same way. So dots move little, and no rounding
/// of the counts shows in the pattern. Cells that no way reaches keep what they have.
void restore_counts(const DotSpec& spec, const CoverageMap& map, const core::CellField& wanted, int threads,
                    DotStore& store);

}  // namespace evenglow::design
