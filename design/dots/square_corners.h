#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace evenglow::design {

/// Corners (mm) of a square of this half width about (0, 0), its side turned by `angle` (rad) from +x,
/// counterclockwise.
inline std::array<std::pair<double, double>, 4> square_corners(double half, double angle) {
  const double c = half * std::cos(angle), s = half * std::sin(angle);
  return {{{-c + s, -s - c}, {c + s, s - c}, {c - s, s + c}, {-c - s, -s + c}}};
}

}  // namespace evenglow::design
