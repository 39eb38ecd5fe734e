#pragma once

#include <cmath>

#include "core/base/units.h"
#include "core/math/select.h"
#include "core/math/vec3.h"

/// Uniform numbers in (0, 1) to directions and points.
namespace evenglow::core {

/// Cosine and sine of 2 pi `turn` for a turn in [0, 1], to 1.2e-15: series about the nearest quarter, without a branch.
struct TurnCosSin {
  double cos = 1.0, sin = 0.0;

  explicit TurnCosSin(double turn) {
    // Not negative, and any of two quarters does halfway; lround would be a call in every walk of a photon.
    const int quarter = static_cast<int>(4.0 * turn + 0.5);  // NOLINT(bugprone-incorrect-roundings)
    const double a = (turn - 0.25 * quarter) * (2.0 * kPi);  // within pi / 4; the difference is exact
    const double a2 = a * a;
    const double c =
        1.0 + a2 * (-1.0 / 2 +
                    a2 * (1.0 / 24 +
                          a2 * (-1.0 / 720 + a2 * (1.0 / 40320 + a2 * (-1.0 / 3628800 +
                                                                       a2 * (1.0 / 479001600 - a2 / 87178291200))))));
    const double s =
        a * (1.0 +
             a2 * (-1.0 / 6 +
                   a2 * (1.0 / 120 + a2 * (-1.0 / 5040 +
                                           a2 * (1.0 / 362880 + a2 * (-1.0 / 39916800 + a2 * (1.0 / 6227020800 -
                                                                                              a2 / 1307674368000)))))));
    const bool odd = quarter % 2 != 0;
    cos = select(quarter == 1 || quarter == 2, -1.0, 1.0) * select(odd, s, c);
    sin = select(quarter == 2 || quarter == 3, -1.0, 1.0) * select(odd, c, s);
  }
};

/// Direction about +z with density cos(theta) / pi.
inline Vec3 sample_lambertian(double u1, double u2) {
  const double sin_theta = std::sqrt(1.0 - u1);
  const TurnCosSin phi(u2);
  return {sin_theta * phi.cos, sin_theta * phi.sin, std::sqrt(u1)};
}

/// Direction about +z with density cos(theta)^n (n + 1) / (2 pi); n = 1 is Lambertian.
inline Vec3 sample_cosine_power(double u1, double u2, double n) {
  if (n == 1.0) return sample_lambertian(u1, u2);
  const double cos2 = std::pow(u1, 2.0 / (n + 1.0));
  const double sin_theta = std::sqrt(std::fmax(0.0, 1.0 - cos2));
  const double phi = 2.0 * kPi * u2;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), std::sqrt(cos2)};
}

/// Direction within `cone` (rad) about +z with density cos(theta) / (pi sin^2 cone); cone = 0 returns +z.
inline Vec3 sample_cosine_cone(double u1, double u2, double sin_cone) {
  const double sin_theta = sin_cone * std::sqrt(u1);
  const double phi = 2.0 * kPi * u2;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), std::sqrt(1.0 - sin_theta * sin_theta)};
}

}  // namespace evenglow::core
