#pragma once

#include <optional>
#include <string>

#include "design/report/report.h"

namespace evenglow::design {

/// A map computed from the maps of two designs.
struct RelatedMap {
  std::string name;  ///< "dbef / lpp"
  core::CellField field;
  core::CellField se;  ///< or without values
};

/// Luminance of `report` over that of `base` cell by cell, each for one lumen of LED flux. Errors to first order, the
/// two traces taken as independent. Not a number where the base is dark. None if the maps have different cells.
std::optional<RelatedMap> luminance_ratio(const Report& report, const Report& base);

/// Luminance of `report`, scaled to the LED flux of `base`, less that of `base`, cd/m2.
std::optional<RelatedMap> luminance_difference(const Report& report, const Report& base);

/// Density of `report` less that of `base`; without errors.
std::optional<RelatedMap> density_difference(const Report& report, const Report& base);

}  // namespace evenglow::design
