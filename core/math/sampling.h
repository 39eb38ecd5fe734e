#pragma once

#include <cmath>

#include "core/base/units.h"
#include "core/math/vec3.h"

/// Uniform numbers in (0, 1) to directions and points.
namespace evenglow::core {

/// Direction about +z with density cos(theta) / pi.
inline Vec3 sample_lambertian(double u1, double u2) {
  const double sin_theta = std::sqrt(1.0 - u1);
  const double phi = 2.0 * kPi * u2;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), std::sqrt(u1)};
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
