#pragma once

#include "core/dots/dot.h"
#include "design/dots/coverage_map.h"

namespace evenglow::design {

/// How far the dots with their center in a cell are from what the cell must hold.
struct CellErrors {
  double worst_dots = 0.0;     ///< greatest error, in areas of the cell's mean dot
  double rms_dots = 0.0;       ///< root mean square of the same
  double rms_relative = 0.0;   ///< root mean square of the area's relative error, of cells that must hold something
  double mean_relative = 0.0;  ///< relative error of the whole area
  std::size_t beyond_one = 0;  ///< cells with an error of more than one dot
  core::CellField held;        ///< share of each cell's area under its dots
};

CellErrors cell_errors(const core::DotPattern& dots, core::Footprint footprint, const CoverageMap& map);

}  // namespace evenglow::design
