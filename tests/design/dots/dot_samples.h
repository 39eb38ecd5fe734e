#pragma once

#include <cmath>
#include <cstdint>

#include "core/dots/dot.h"
#include "core/montecarlo/photon_rng.h"
#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"

/// Small densities and patterns for the tests of design/dots.
namespace evenglow::tests {

/// 20 mm x 10 mm in 16 x 8 cells, coverage from 0.03 to 0.25 along x.
inline core::CellField graded_coverage() {
  core::CellField field(core::CellGrid::over(16, 8, 0.0, 0.0, 20.0, 10.0), 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double x = static_cast<double>(i % 16) / 15.0;
    field.values[i] = 0.03 * std::pow(0.25 / 0.03, x);
  }
  return field;
}

inline design::FreeArea whole_plate(std::vector<design::RectangleZone> rectangles = {},
                                    std::vector<design::CircleZone> circles = {}, design::Margins margins = {}) {
  return {{0.0, 20.0, 0.0, 10.0}, margins, std::move(rectangles), std::move(circles)};
}

/// Dots by chance on 20 mm x 10 mm.
inline core::DotPattern random_dots(std::size_t count, std::uint64_t seed, float radius = 0.005f) {
  core::PhotonRng rng({seed, 0, 0}, 0);
  core::DotPattern dots(count);
  for (core::Dot& dot : dots) {
    dot.x = 20.0 * rng.uniform();
    dot.y = 10.0 * rng.uniform();
    dot.radius = radius;
  }
  return dots;
}

/// Dots on a square lattice of this pitch (mm).
inline core::DotPattern lattice_pattern(double pitch, float radius = 0.03f) {
  core::DotPattern dots;
  for (double y = 0.5 * pitch; y < 10.0; y += pitch) {
    for (double x = 0.5 * pitch; x < 20.0; x += pitch) dots.push_back({x, y, radius, 0.0f});
  }
  return dots;
}

}  // namespace evenglow::tests
