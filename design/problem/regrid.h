#pragma once

#include "core/math/cell_field.h"

namespace evenglow::design {

/// The field on other cells. Along an axis in which the new cells are larger each takes the mean of what it covers
/// (weighted by length, so that no detail is missed and noise averages out); in which they are smaller, linear
/// interpolation between the centers. Beyond the field the outermost cells hold. The mean is kept where both cover the
/// same rectangle and the new cells are larger.
core::CellField regrid(const core::CellField& field, const core::CellGrid& grid);

}  // namespace evenglow::design
