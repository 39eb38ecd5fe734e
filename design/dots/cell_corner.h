#pragma once

#include <cstddef>

#include "core/math/cell_field.h"

namespace evenglow::design {

/// The corner of cell number `cell` (rows of x, one after another) with the least x and y, mm.
struct CellCorner {
  double x = 0.0, y = 0.0;
};

inline CellCorner cell_corner(const core::CellGrid& grid, std::size_t cell) {
  const auto columns = static_cast<std::size_t>(grid.nx);
  const std::size_t column = cell % columns, row = cell / columns;
  return {grid.x0 + static_cast<double>(column) * grid.dx, grid.y0 + static_cast<double>(row) * grid.dy};
}

}  // namespace evenglow::design
