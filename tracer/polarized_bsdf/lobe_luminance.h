#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/lobe_parameters.h"
#include "tracer/polarized_bsdf/luminance_table.h"

/// The luminance model of `lobe_fit` for any number type (double, or one with derivatives).
namespace evenglow::tracer {

/// Widths, amplitudes and set-up of a fit.
template <typename T>
struct LobeValues {
  T sx, sy, s2, s3p, s3b, p1, p3, b1, b2, b3, t1, t2, t3, a1, a2, a3, a2b, a3b, e0;
  T throughput, offset_reflection, offset_transmission;
};

/// Lobe at normal incidence, theta in the plane phi = 0.
template <typename T>
T lobe_value(const LuminanceRow& row, const T& sx, const T& sy) {
  using std::exp;
  const double d = std::sin(row.theta);
  const double dx = d * std::cos(row.psi), dy = -d * std::sin(row.psi);
  return exp(-0.5 * (dx * dx / (sx * sx) + dy * dy / (sy * sy)));
}

/// e0 f of pass and of block light.
template <typename T>
std::array<T, 2> lobe_amplitudes(const LobeValues<T>& v, ScatterKind kind, const LuminanceRow& row) {
  const auto round = [&](const T& s) { return lobe_value(row, s, s); };
  if (kind == ScatterKind::transmission) {
    const T middle = round(v.t2), wide = round(v.t3);
    return {v.a1 * round(v.t1) + v.a2 * middle + v.a3 * wide, v.a2b * middle + v.a3b * wide};
  }
  const T narrow = lobe_value(row, v.sx, v.sy);
  return {v.p1 * narrow + v.p3 * round(v.s3p), v.b1 * narrow + v.b2 * round(v.s2) + v.b3 * round(v.s3b)};
}

template <typename T>
T lobe_luminance(const LobeValues<T>& v, ScatterKind kind, const LuminanceRow& row) {
  using std::cos;
  const std::array<T, 2> f = lobe_amplitudes(v, kind, row);
  T half = 0.5 * (f[0] + f[1]);
  if (!row.filtered) return half;
  const T& offset = kind == ScatterKind::reflection ? v.offset_reflection : v.offset_transmission;
  return 0.5 * v.throughput * (half + 0.5 * (f[0] - f[1]) * cos(2.0 * (row.filter - row.psi - offset)));
}

/// `lobe_integral` of a round lobe, in closed form.
template <typename T>
T round_integral(const T& s) {
  using std::exp;
  return 2.0 * core::kPi * s * s * (1.0 - exp(-0.5 / (s * s)));
}

/// `lobe_integral` for any number type.
template <typename T>
T oval_integral(const T& sx, const T& sy) {
  using std::exp;
  constexpr int kAngles = 96;
  T sum(0.0);
  for (int i = 0; i < kAngles; ++i) {
    const double angle = core::kPi * i / kAngles;
    const double c = std::cos(angle), s = std::sin(angle);
    const T a = c * c / (sx * sx) + s * s / (sy * sy);
    sum += (1.0 - exp(-0.5 * a)) / a;
  }
  return sum * (2.0 * core::kPi / kAngles);
}

/// a1 and b1 from the rest: R_p + T_p = R_b + T_b = 1 - absorption.
template <typename T>
void constrain_energy(LobeValues<T>& v, double absorption) {
  const T narrow = oval_integral(v.sx, v.sy), all = (1.0 - absorption) * v.e0;
  const T middle = round_integral(v.t2), wide = round_integral(v.t3);
  v.a1 = (all - v.p1 * narrow - v.p3 * round_integral(v.s3p) - v.a2 * middle - v.a3 * wide) / round_integral(v.t1);
  v.b1 = (all - v.b2 * round_integral(v.s2) - v.b3 * round_integral(v.s3b) - v.a2b * middle - v.a3b * wide) / narrow;
}

}  // namespace evenglow::tracer
