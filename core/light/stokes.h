#pragma once

#include <cmath>

#include "core/math/vec3.h"

/// Stokes vectors and the frames they are counted in. Signs are those of docs/conventions.md:
/// (e1, e2, k) is right-handed, k the direction of travel; with complex amplitudes E1, E2 and time dependence
/// exp(-i w t):  I = |E1|^2 + |E2|^2,  Q = |E1|^2 - |E2|^2,  U + iV = 2 E1 conj(E2).
/// V > 0 is right circular: the field turns clockwise for an observer who looks towards the source.
namespace evenglow::core {

/// Frame of a Stokes vector: direction of travel k and e1, unit and perpendicular; e2 = k x e1.
struct PolarizationFrame {
  Vec3 k = Vec3::UnitZ();
  Vec3 e1 = Vec3::UnitX();

  Vec3 e2() const { return k.cross(e1); }
  /// A frame for a direction with an arbitrary (but reproducible) e1.
  static PolarizationFrame any(const Vec3& k) {
    // Duff et al., "Building an orthonormal basis, revisited" (JCGT 6, 2017): no branch on the axis, no square root.
    const double sign = std::copysign(1.0, k.z());
    const double a = -1.0 / (sign + k.z());
    const double b = k.x() * k.y() * a;
    return {k, Vec3(1.0 + sign * k.x() * k.x() * a, sign * b, -sign * k.x())};
  }
  /// The frame with `e1` = s x k for a unit vector s perpendicular to k, so that e2 = s.
  static PolarizationFrame with_e2(const Vec3& k, const Vec3& s) { return {k, s.cross(k)}; }
};

/// Polarized light of one ray: I (lm or any unit of power), Q, U, V in the frame it carries.
/// Promise: Q^2 + U^2 + V^2 <= I^2 up to rounding.
struct StokesVector {
  double I = 0.0;
  double Q = 0.0;
  double U = 0.0;
  double V = 0.0;
  PolarizationFrame frame;

  static StokesVector unpolarized(double power, const PolarizationFrame& frame) { return {power, 0, 0, 0, frame}; }
  /// Fully linear light whose field makes `angle` (rad) with e1, counted towards e2.
  static StokesVector linear(double power, double angle, const PolarizationFrame& frame);

  bool is_unpolarized() const { return Q == 0.0 && U == 0.0 && V == 0.0; }
  /// sqrt(Q^2 + U^2 + V^2) / I.
  double degree_of_polarization() const;
  /// The same light in the frame whose first axis is `e1` (unit, perpendicular to frame.k).
  StokesVector in_frame(const Vec3& e1) const {
    if (is_unpolarized()) return unpolarized(I, {frame.k, e1});
    return turned(frame.e1.dot(e1), frame.k.cross(frame.e1).dot(e1), e1);
  }
  /// The same light in the frame whose first axis is `new_e1` = cosine * frame.e1 + sine * frame.e2.
  StokesVector turned(double cosine, double sine, const Vec3& new_e1) const {
    // Rotation of the axes by a: Q' = Q cos 2a + U sin 2a, U' = -Q sin 2a + U cos 2a (Goldstein, Polarized Light, 5.4).
    const double cos2 = cosine * cosine - sine * sine;
    const double sin2 = 2.0 * cosine * sine;
    return {I, Q * cos2 + U * sin2, U * cos2 - Q * sin2, V, {frame.k, new_e1}};
  }
  /// The same light times `factor`.
  StokesVector scaled(double factor) const { return {I * factor, Q * factor, U * factor, V * factor, frame}; }
};

}  // namespace evenglow::core
