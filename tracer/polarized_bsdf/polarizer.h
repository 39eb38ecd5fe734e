#pragma once

#include <cmath>

#include <Eigen/Core>

namespace evenglow::tracer {

/// What stands in a channel (illumination or observation) of a film measurement.
enum class PolarizerKind { none = 0, linear = 1, right = 2, left = 3 };

/// Principal transmittances of a polarizer, 0 <= k2 < k1 <= 1: greatest and least transmittance for linear light. An
/// ideal one has 1 and 0.
struct PrincipalTransmittances {
  double k1 = 1.0;
  double k2 = 0.0;
  /// Degree of polarization that natural light leaves with; 1 for an ideal polarizer.
  double contrast() const { return (k1 - k2) / (k1 + k2); }
};

/// Polarization behind a polarizer in units of its intensity: (1, q, u, v). `angle` (rad) counts from e1 towards e2 (or
/// from the film axis, if the matrix is to be counted from there). `v_sign`: what right circular light has for V in the
/// count of the matrix, +1 where (e1, e2, k) is right-handed, -1 where it is left-handed (tangential count of a ray
/// that travels down, docs/conventions.md).
inline Eigen::Vector4d polarization_of(PolarizerKind kind, double angle, double contrast, double v_sign) {
  switch (kind) {
    case PolarizerKind::linear:
      return {1.0, contrast * std::cos(2.0 * angle), contrast * std::sin(2.0 * angle), 0.0};
    case PolarizerKind::right:
      return {1.0, 0.0, 0.0, v_sign * contrast};
    case PolarizerKind::left:
      return {1.0, 0.0, 0.0, -v_sign * contrast};
    case PolarizerKind::none:
      break;
  }
  return {1.0, 0.0, 0.0, 0.0};
}

/// Row vector that light is multiplied with by an analyzer and a detector that is blind to polarization: the first row
/// of the Mueller matrix of the polarizer, (k1 + k2)/2 (1, q, u, v); (1, 0, 0, 0) without one.
inline Eigen::Vector4d analyzer_of(PolarizerKind kind, double angle, const PrincipalTransmittances& k, double v_sign) {
  const double throughput = kind == PolarizerKind::none ? 1.0 : 0.5 * (k.k1 + k.k2);
  return throughput * polarization_of(kind, angle, k.contrast(), v_sign);
}

}  // namespace evenglow::tracer
