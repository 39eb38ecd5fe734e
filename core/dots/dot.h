#pragma once

#include <vector>

/// The dots of a plate one by one, as places of dots of one shape.
namespace evenglow::core {

/// One dot of the pattern. Its shape (round or square footprint, cap, cone, ink) is that of the whole pattern.
struct Dot {
  double x = 0.0;      ///< mm, center
  double y = 0.0;      ///< mm, center
  float radius = 0.0;  ///< mm, half the diameter of a round footprint, half the width of a square one; > 0
  float angle = 0.0;   ///< rad, of the dot's own axis from +x towards +y

  bool operator==(const Dot&) const = default;
};

/// Outline of every dot on the face.
enum class Footprint { round, square };

/// Area (mm2) under a dot of this diameter or width (mm).
constexpr double footprint_area(Footprint footprint, double diameter) {
  constexpr double kQuarterPi = 0.78539816339744830962;
  return (footprint == Footprint::round ? kQuarterPi : 1.0) * diameter * diameter;
}

/// Diameter (mm) of the circle around a dot of this diameter or width: what must not overlap.
constexpr double footprint_span(Footprint footprint, double diameter) {
  constexpr double kRoot2 = 1.41421356237309504880;
  return footprint == Footprint::round ? diameter : kRoot2 * diameter;
}

using DotPattern = std::vector<Dot>;

}  // namespace evenglow::core
