#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/select.h"

namespace evenglow::tracer {

/// Outgoing directions seen from the specular (or direct) axis, in direction cosines. The tangential part of the ray is
///
///     beta_out = beta_in + u^2 r (cos phi', sin phi'),   r(phi') = way from beta_in to the unit circle,
///
/// with beta_in = (sin sigma, 0) and phi' counted from the plane of incidence; so the horizon is u = 1 whatever the
/// incidence, and the axis is u = 0 for both reflection and transmission. Projected solid angle is area in beta:
/// cos(theta) dOmega = dbeta = 2 u^3 r^2 du dphi'.

/// r(phi'). `sin_in` = sin sigma; `cos2_in` = cos^2 sigma, given apart because it is the precise one near grazing.
inline double horizon_distance(double sin_in, double cos2_in, double cos_phi, double sin_phi) {
  const double root = std::sqrt(cos2_in * sin_phi * sin_phi + cos_phi * cos_phi);  // sqrt(1 - sin^2 sigma sin^2 phi')
  const double forward = sin_in * cos_phi;
  const double sum = root + std::abs(forward);  // root - forward, without a difference of near-equal numbers
  return core::select(forward > 0.0, cos2_in / sum, sum);
}

/// Angle of a direction in [0, 2 pi).
inline double full_angle(double y, double x) {
  const double angle = std::atan2(y, x);
  return angle < 0.0 ? angle + 6.283185307179586 : angle;
}

/// Angles of an outgoing direction as the table counts them, rad.
struct AxisDirection {
  double phi = 0.0, theta = 0.0;
};

/// The direction at (u, phi') of an incidence of polar angle `sigma` (rad).
inline AxisDirection seen_from_axis(double sigma, double u, double phi) {
  const double s = std::sin(sigma);
  const double c = std::cos(sigma);
  const double way = u * u * horizon_distance(s, c * c, std::cos(phi), std::sin(phi));
  if (way == 0.0) return {phi, 0.0};
  const double x = s + way * std::cos(phi);
  const double y = way * std::sin(phi);
  const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
  // Parts along the axis (s, 0, c), along (c, 0, -s) and along y.
  const double in_plane = c * x - s * z;
  return {std::atan2(y, in_plane), std::atan2(std::hypot(in_plane, y), s * x + c * z)};
}

}  // namespace evenglow::tracer
