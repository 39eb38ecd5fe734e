#pragma once

#include <vector>

#include "core/math/cell_field.h"

namespace evenglow::design {

/// Whole numbers for real ones, each rounded down or up, such that sums over any neighborhood stay close: what rounding
/// takes from a cell goes to its neighbors (error diffusion on serpentine rows; Floyd & Steinberg, Proc. SID 17, 1976).
/// `wanted`: at least 0.
std::vector<int> whole_counts(const core::CellField& wanted);

}  // namespace evenglow::design
