#include "tracer/geometry/mesh.h"

#include <cmath>
#include <limits>

namespace evenglow::tracer {

const char* side_name(Side side) {
  static constexpr const char* kNames[] = {"left", "right", "front", "back", "bottom", "top"};
  return kNames[static_cast<int>(side)];
}

int axis_of(Side side) {
  return static_cast<int>(side) / 2;
}

bool is_upper(Side side) {
  return static_cast<int>(side) % 2 == 1;
}

core::Vec3 outward(Side side) {
  core::Vec3 normal = core::Vec3::Zero();
  normal[axis_of(side)] = is_upper(side) ? 1.0 : -1.0;
  return normal;
}

bool Box::contains(const core::Vec3& p) const {
  return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
}

Side Box::exit_side(const core::Vec3& origin, const core::Vec3& direction) const {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  Side leave_side = Side::kTop;
  bool meets = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (d == 0.0) {
      meets = meets && origin[axis] >= min[axis] && origin[axis] <= max[axis];
      continue;
    }
    const double near = ((d > 0.0 ? min : max)[axis] - origin[axis]) / d;
    const double far = ((d > 0.0 ? max : min)[axis] - origin[axis]) / d;
    if (near > enter) enter = near;
    if (far < leave) {
      leave = far;
      leave_side = static_cast<Side>(2 * axis + (d > 0.0 ? 1 : 0));
    }
  }
  if (meets && leave >= enter) return leave_side;
  for (int axis = 0; axis < 3; ++axis) {
    if (origin[axis] <= min[axis]) return static_cast<Side>(2 * axis);
    if (origin[axis] >= max[axis]) return static_cast<Side>(2 * axis + 1);
  }
  return leave_side;
}

Quad side_of(const Box& box, Side side) {
  const int axis = axis_of(side);
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  core::Vec3 u = core::Vec3::Zero();
  core::Vec3 v = core::Vec3::Zero();
  u[a] = box.max[a] - box.min[a];
  v[b] = box.max[b] - box.min[b];
  core::Vec3 corner = box.min;
  corner[axis] = box.plane(side);
  return is_upper(side) ? Quad{corner, u, v} : Quad{corner, v, u};
}

}  // namespace evenglow::tracer
