#include "core/light/stokes.h"

#include <cmath>

namespace evenglow::core {

PolarizationFrame PolarizationFrame::any(const Vec3& k) {
  // Duff et al., "Building an orthonormal basis, revisited" (JCGT 6, 2017): no branch on the axis, no square root.
  const double sign = std::copysign(1.0, k.z());
  const double a = -1.0 / (sign + k.z());
  const double b = k.x() * k.y() * a;
  return {k, Vec3(1.0 + sign * k.x() * k.x() * a, sign * b, -sign * k.x())};
}

StokesVector StokesVector::linear(double power, double angle, const PolarizationFrame& frame) {
  return {power, power * std::cos(2.0 * angle), power * std::sin(2.0 * angle), 0.0, frame};
}

double StokesVector::degree_of_polarization() const {
  return I > 0.0 ? std::sqrt(Q * Q + U * U + V * V) / I : 0.0;
}

StokesVector StokesVector::in_frame(const Vec3& e1) const {
  // Rotation of the axes by a: Q' = Q cos 2a + U sin 2a, U' = -Q sin 2a + U cos 2a (Goldstein, Polarized Light, 5.4).
  const double c = frame.e1.dot(e1);
  const double s = frame.k.cross(frame.e1).dot(e1);
  const double cos2 = c * c - s * s;
  const double sin2 = 2.0 * c * s;
  return {I, Q * cos2 + U * sin2, U * cos2 - Q * sin2, V, {frame.k, e1}};
}

}  // namespace evenglow::core
