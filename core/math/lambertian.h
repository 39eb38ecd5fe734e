#pragma once

#include <cmath>

#include "core/math/vec3.h"

namespace evenglow::core {

/// Direction about +z with density cos(theta) / pi from as many uniform numbers (`rng.uniform()`) as it takes, 2.55 on
/// average: a point of the unit disk raised to the hemisphere (Malley), without sine and cosine.
template <typename Rng>
[[gnu::always_inline]] inline Vec3 draw_lambertian(Rng& rng) {
  while (true) {
    const double a = 2.0 * rng.uniform() - 1.0;
    const double b = 2.0 * rng.uniform() - 1.0;
    const double r2 = a * a + b * b;
    if (r2 < 1.0) return {a, b, std::sqrt(1.0 - r2)};
  }
}

}  // namespace evenglow::core
