#include "tracer/optics/bsdf.h"

#include <cmath>

namespace evenglow::tracer {

TangentialFrame tangential_frame(const core::Vec3& k) {
  TangentialFrame t;
  const double sin2 = k.x() * k.x() + k.y() * k.y();
  // Below 1e-9 rad the azimuth is noise; e1 must stay perpendicular to k to rounding, so k itself is kept.
  if (sin2 > 1e-18) {
    t.sin_polar = std::sqrt(sin2);
    t.azimuth_cos = k.x() / t.sin_polar;
    t.azimuth_sin = k.y() / t.sin_polar;
  }
  const double cos_polar = std::abs(k.z());
  t.sign = k.z() >= 0.0 ? 1.0 : -1.0;
  t.frame.k = k;
  t.frame.e1 = core::Vec3(t.azimuth_cos * cos_polar, t.azimuth_sin * cos_polar, -t.sign * t.sin_polar);
  return t;
}

Eigen::Vector4d to_film(const core::StokesVector& light, const TangentialFrame& frame) {
  const core::StokesVector s = light.in_frame(frame.frame.e1);
  return {s.I, s.Q, frame.sign * s.U, frame.sign * s.V};
}

core::StokesVector from_film(const Eigen::Vector4d& s, const TangentialFrame& frame) {
  return {s[0], s[1], frame.sign * s[2], frame.sign * s[3], frame.frame};
}

}  // namespace evenglow::tracer
