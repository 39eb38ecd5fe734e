#pragma once

#include "core/config/matrix_file.h"
#include "core/math/cell_field.h"

namespace evenglow::design {

/// A map of the run file's user: a matrix that is stretched over a rectangle of the backlight.
struct MapTable : core::NumberMatrix {
  /// The map over the rectangle of these cells, on these cells (regrid.h).
  core::CellField over(const core::CellGrid& grid) const;
};

}  // namespace evenglow::design
