#pragma once

#include <vector>

#include "core/math/vec3.h"

namespace evenglow::tracer {

/// Parallelogram corner + a u + b v with a, b in [0, 1] (mm); the normal is unit(u x v).
struct Quad {
  core::Vec3 corner;
  core::Vec3 u;
  core::Vec3 v;

  core::Vec3 normal() const { return u.cross(v).normalized(); }
};

/// The six sides of a box and of the backlight.
enum class Side { kLeft, kRight, kFront, kBack, kBottom, kTop };
inline constexpr int kSides = 6;
/// `left` x = min, `right` x = max, `front` y = min, `back` y = max, `bottom` z = min, `top` z = max.
const char* side_name(Side side);
/// Unit normal that points out of a box at its side.
core::Vec3 outward(Side side);
/// 0, 1, 2 for x, y, z; and whether the side is at the upper end of that axis.
int axis_of(Side side);
bool is_upper(Side side);

/// Axis-parallel box (mm).
struct Box {
  core::Vec3 min = core::Vec3::Zero();
  core::Vec3 max = core::Vec3::Zero();

  /// Coordinate of a side along its axis.
  double plane(Side side) const { return (is_upper(side) ? max : min)[axis_of(side)]; }
  bool contains(const core::Vec3& p) const;
  /// The side through which a ray leaves the space of the box: the face where it leaves the box if it meets the box,
  /// else the side on which it starts.
  Side exit_side(const core::Vec3& origin, const core::Vec3& direction) const;
};

/// The rectangle of a box's side, its normal pointing out.
Quad side_of(const Box& box, Side side);

}  // namespace evenglow::tracer
