#pragma once

#include <cstddef>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"

namespace evenglow::design {

/// The wanted shape of the luminance on the cells of the display, and the cells that count.
///
/// All that judges or turns a design looks at luminance over target: its RMS is the standard deviation over the mean of
/// that ratio, over the cells that count.
class Target {
 public:
  /// Throws Error if no cell counts.
  Target(const DesignSpec& spec, const core::CellGrid& display);

  /// Uniform, and every cell counts.
  bool plain() const { return plain_; }
  /// Mean 1 over the cells that count; 0 where a cell does not.
  const core::CellField& relative() const { return relative_; }
  std::size_t counted() const { return counted_.size(); }
  double share_counted() const;  ///< of the cells

  /// Luminance over target of the cells that count, batch by batch.
  core::Tally judged(const core::Tally& luminance) const;
  /// Replaces the luminance of an observation (map and batches) by luminance over target; a cell that does not count
  /// takes the value of the nearest one that does, so that its density follows.
  void flatten(Observation& observation) const;

 private:
  void flatten(std::vector<double>& values) const;

  bool plain_ = true;
  core::CellField relative_;
  std::vector<std::size_t> counted_;  ///< indices of the cells that count
  std::vector<std::size_t> nearest_;  ///< for each cell, the nearest one that counts
};

/// The cells of the display, on which a target has this shape, that count: the mask holds 0.5 at least, the shape more
/// than next to nothing. None: a design has nothing to look at.
std::vector<std::size_t> counted_cells(const DesignSpec& spec, const core::CellField& shape);

/// `uniform` 1; `center_weighted`: 1 - (1 - corner) (u^2 + v^2) / 2 with u, v from -1 to 1 across the display, so that
/// the corners have `corner` of the center and the middles of the sides lie between; a map: its values.
core::CellField target_shape(const TargetSpec& spec, const core::CellGrid& display);

}  // namespace evenglow::design
