#pragma once

#include <cmath>

#include "core/math/vec3.h"

namespace evenglow::core {

/// Direction about +z with density cos(theta) / pi from as many uniform numbers (`rng.uniform()`) as it takes, 2.55 on
/// average: a point of the unit disk raised to the hemisphere (Malley), without sine and cosine. `first`:
/// the first of them, where one is at hand.
template <typename Rng>
[[gnu::always_inline]] inline Vec3 draw_lambertian(Rng& rng, double first) {
  double a = 2.0 * first - 1.0;
  while (true) {
    const double b = 2.0 * rng.uniform() - 1.0;
    const double r2 = a * a + b * b;
    if (r2 < 1.0) return {a, b, std::sqrt(1.0 - r2)};
    a = 2.0 * rng.uniform() - 1.0;
  }
}
template <typename Rng>
[[gnu::always_inline]] inline Vec3 draw_lambertian(Rng& rng) {
  return draw_lambertian(rng, rng.uniform());
}

}  // namespace evenglow::core
