#pragma once

#include <string>
#include <vector>

#include "design/report/report.h"

namespace evenglow::design {

/// A map with what a file of many maps tells of it.
struct NamedMap {
  std::string name;         ///< of letters, digits and underscores: "luminance_se"
  std::string unit;         ///< "cd/m2", "1"
  std::string description;  ///< one line
  core::CellField field;
};

/// All maps of a run that have values: luminance and density with what belongs to them, color where it was traced.
std::vector<NamedMap> named_maps(const Report& report);

/// Of a comparison: ratio and difference of the luminance, difference of the density of each variant against the first,
/// named after the variants, as in "ratio_dbef_over_lpp"; other characters than letters and digits become underscores.
std::vector<NamedMap> named_maps(const Comparison& comparison);

}  // namespace evenglow::design
