#pragma once

#include "core/math/cell_field.h"

namespace evenglow::design {

/// A field without negative values smoothed over windows of any width at the same cost: three running means along each
/// axis, together close to a Gaussian of standard deviations `sigma_x` and `sigma_y` (cells; below about 1/2: not
/// smoothed). Reflects at the borders, keeps the mean.
core::CellField blur(core::CellField field, double sigma_x, double sigma_y);

}  // namespace evenglow::design
