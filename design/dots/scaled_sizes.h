#pragma once

#include <functional>

#include "core/dots/dot.h"
#include "core/math/cell_field.h"
#include "design/dots/dot_spec.h"
#include "design/dots/keep_out.h"

namespace evenglow::design {

/// Gives the dots new sizes on their places: the area of each is multiplied by `factor` at its center (mm), then
/// rounded to whole size steps, each dot taking over what rounding the ones before it in its cell of `cells` left.
/// Kept are the limits of the sizes, the free area, and the gap: a dot grows no farther than its neighbors let it.
/// `dots`: ordered by the cells; so is the result.
core::DotPattern scaled_sizes(const DotSpec& spec, const FreeArea& free, const core::CellGrid& cells,
                              const core::DotPattern& dots, const std::function<double(double, double)>& factor,
                              int threads);

}  // namespace evenglow::design
