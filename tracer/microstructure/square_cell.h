#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/vec3.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {

/// Way along a ray from `p` to the wall at +half or -half that it runs against; very far if it runs along it.
inline double way_to_walls(double p, double k, double half) {
  return k != 0.0 ? std::clamp((std::copysign(half, k) - p) / k, 0.0, 1e300) : 1e300;
}

/// Square cell |x|, |y| <= half of a periodic pattern.
struct SquareCell {
  double half = 1.0;

  core::Vec3 point(core::PhotonRng& rng) const {
    const double x = half * (2.0 * rng.uniform() - 1.0);
    return {x, half * (2.0 * rng.uniform() - 1.0), 0.0};
  }
  double way_to_wall(const core::Vec3& p, const core::Vec3& k) const {
    return std::min(way_to_walls(p.x(), k.x(), half), way_to_walls(p.y(), k.y(), half));
  }
  void next_cell(core::Vec3& p, const core::Vec3& k) const {
    const double way = way_to_wall(p, k);
    const bool over_x = way_to_walls(p.x(), k.x(), half) <= way;
    p += way * k;
    const int axis = over_x ? 0 : 1;
    p[axis] = -std::copysign(half, k[axis]);
    p[1 - axis] = std::clamp(p[1 - axis], -half, half);
  }
};

}  // namespace evenglow::tracer
