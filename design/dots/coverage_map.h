#pragma once

#include "core/math/cell_field.h"
#include "design/dots/keep_out.h"

namespace evenglow::design {

/// What share of the face the dots are to cover, cell by cell and smooth within the cells.
class CoverageMap {
 public:
  /// `coverage`: share of each cell's area under footprints (density times the shape's `fill`), in [0, 1].
  CoverageMap(core::CellField coverage, FreeArea free);

  const core::CellGrid& grid() const { return coverage_.grid; }
  const core::CellField& coverage() const { return coverage_; }
  const FreeArea& free() const { return free_; }

  /// Share of the cell's area that is free of margins and zones.
  double free_share(std::size_t cell) const { return free_share_.values[cell]; }
  /// Area (mm2) under dots that the cell must hold: its coverage times its free area.
  double wanted(std::size_t cell) const {
    return coverage_.values[cell] * free_share_.values[cell] * coverage_.grid.cell_area();
  }
  double wanted_in_all() const;

  /// Coverage at a point: bilinear between values at the cells' centers that are chosen such that the mean over each
  /// cell comes near the cell's coverage (a few steps of fixed-point iteration, never below half or above twice the
  /// cell's own). So there are no steps at the borders of cells.
  double at(double x, double y) const;

 private:
  core::CellField coverage_;
  FreeArea free_;
  core::CellField free_share_;
  core::CellField nodes_;
};

}  // namespace evenglow::design
