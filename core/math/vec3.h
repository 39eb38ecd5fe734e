#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace evenglow::core {

/// Position (mm) or unit direction.
using Vec3 = Eigen::Vector3d;
using Vec2 = Eigen::Vector2d;

}  // namespace evenglow::core
