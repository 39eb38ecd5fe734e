#pragma once

#include "core/math/vec3.h"

namespace evenglow::core {

/// Wavelengths (nm) that the tables hold; outside nothing is seen.
inline constexpr double kShortestVisible = 380.0;
inline constexpr double kLongestVisible = 780.0;

/// CIE 1931 color-matching functions of the 2-degree observer (CIE 015:2018, table of 5 nm), linear between the
/// entries: (x, y, z) per unit radiant power at `wavelength` (nm). y is V(lambda). Zero outside the table.
Vec3 color_matching(double wavelength);

}  // namespace evenglow::core
