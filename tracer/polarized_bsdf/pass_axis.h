#pragma once

#include <cmath>

namespace evenglow::tracer {

/// A direction of linear polarization in the tangential frame of a ray, as the double angle that Stokes vectors need.
struct AxisAngle {
  double cos2 = 1.0;
  double sin2 = 0.0;
};

/// Pass axis of a film as an oblique ray sees it: the angle chi from e1 of the ray's tangential frame with
///
///     tan chi = tan psi cos sigma',  same quadrant as psi,  sin sigma' = sin sigma / n.
///
/// Derivation. Inside the film the ray travels along k = (sin sigma', 0, cos sigma') with e1 = (cos sigma', 0, -sin
/// sigma'), e2 = y (plane of incidence xz). The film takes out (absorbs, or reflects) the field along its block axis b
/// = (-sin psi, cos psi, 0) projected on the wave front: (b.e1, b.e2) = (-sin psi cos sigma', cos psi). What passes is
/// perpendicular to that: (cos psi, sin psi cos sigma'). This is the rule of an O-type polarizer (Yeh & Gu, Optics of
/// Liquid Crystal Displays, 2nd ed., sect. 2.5: iodine absorbs the extraordinary wave) and the one that the DBEF data
/// of configs/data/README.md are given with (n = 1.58).
///
/// `cos_psi`, `sin_psi`: of the pass axis' azimuth from the ray's tangential direction; `sin_sigma` outside, in air.
inline AxisAngle pass_axis(double cos_psi, double sin_psi, double sin_sigma, double n) {
  const double s = sin_sigma / n;
  const double c2 = 1.0 - s * s;  // cos^2 sigma'
  const double x2 = cos_psi * cos_psi;
  const double y2 = sin_psi * sin_psi * c2;
  const double scale = 1.0 / (x2 + y2);
  // 2 cos psi sin psi cos sigma' needs the root; n > 1 keeps it real.
  return {(x2 - y2) * scale, 2.0 * cos_psi * sin_psi * std::sqrt(c2) * scale};
}

}  // namespace evenglow::tracer
