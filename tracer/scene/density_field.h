#pragma once

#include "core/math/cell_field.h"

namespace evenglow::tracer {

/// Share of each cell's area under microstructure (0 to 1): the one thing that a design turns.
struct DensityField {
  core::CellField cells;

  /// Density at a point of the patterned face (mm); constant within a cell, the nearest cell's beyond the border.
  double at(double x, double y) const { return cells.at(x, y); }
};

/// Every value moved into [min, max].
DensityField clamped(DensityField field, double min, double max);

}  // namespace evenglow::tracer
