#include "tracer/microstructure/pyramid.h"

#include <cmath>

#include "tracer/microstructure/bump_keys.h"

namespace evenglow::tracer {

using core::Vec3;

SquarePyramid::SquarePyramid(double flank, double truncation, double fill)
    : cell_{1.0 / std::sqrt(fill)}, height_(std::tan(flank) * (1.0 - truncation)) {
  const double s = std::sin(flank);
  const double c = std::cos(flank);
  facets_.normals = {Vec3(s, 0, c), Vec3(-s, 0, c), Vec3(0, s, c), Vec3(0, -s, c), Vec3(0, 0, 1)};
  facets_.offsets = {s, s, s, s, height_};
}

Microstructure make_pyramid(const core::ConfigNode& node) {
  const BumpPlacement placement =
      read_placement(node, "direction of a side of the base, counted from +x towards +y", 0.0);
  const Flank flank = read_flank(node);
  const double fill = read_fill(node, 1.0);
  return bump_of("pyramid", SquarePyramid(flank.angle, flank.truncation, fill), placement, fill);
}

}  // namespace evenglow::tracer
