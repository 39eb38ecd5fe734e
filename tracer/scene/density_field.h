#pragma once

#include <memory>

#include "core/math/cell_field.h"

namespace evenglow::tracer {

class DotGrid;

/// Share of each cell's area under microstructure (0 to 1): the one thing that a design turns.
struct DensityField {
  core::CellField cells;
  /// The pattern itself, if it is to be traced dot by dot: then `cells` only tells what of each cell it covers.
  std::shared_ptr<const DotGrid> dots{};

  /// Density at a point of the patterned face (mm); constant within a cell, the nearest cell's beyond the border. With
  /// dots, 1 within a dot's footprint and 0 beside.
  double at(double x, double y) const {
    return dots != nullptr ? dots_at(x, y) : cells.at(x, y);
  }

 private:
  double dots_at(double x, double y) const;
};

/// Every value moved into [min, max].
DensityField clamped(DensityField field, double min, double max);

}  // namespace evenglow::tracer
