#include "tracer/optics/dielectric_face.h"

#include <cmath>
#include <complex>

#include "core/light/fresnel.h"

namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

/// Unit vector normal to the plane of incidence: s = z x h = (x, y, 0), with h = +x at normal incidence.
struct PlaneNormal {
  double x = 0.0;
  double y = 1.0;

  explicit PlaneNormal(const Vec3& k) {
    const double sin2 = k.x() * k.x() + k.y() * k.y();
    if (sin2 < 1e-18) return;
    const double inverse = 1.0 / std::sqrt(sin2);
    x = -k.y() * inverse;
    y = k.x() * inverse;
  }
  /// s x k.
  Vec3 cross(const Vec3& k) const { return {y * k.z(), -x * k.z(), x * k.y() - y * k.x()}; }
  double dot(const Vec3& v) const { return x * v.x() + y * v.y(); }
  /// Frame of a ray in the plane of incidence: e1 = s x k, so that e2 = s.
  core::PolarizationFrame frame(const Vec3& k) const { return {k, cross(k)}; }
};

/// The light in the frame whose e2 is s: e1' = s x k, so that e1 . e1' = cos and e2 . e1' = (k x e1) . (s x k) = -e1 .
/// s.
StokesVector seen_along(const StokesVector& light, const PlaneNormal& s) {
  const Vec3 e1 = s.cross(light.frame.k);
  return light.turned(light.frame.e1.dot(e1), -s.dot(light.frame.e1), e1);
}

/// Light with real amplitudes E_p' = a_p E_p, E_s' = a_s E_s, rescaled to power `I`; incident Q = |E_p|^2 - |E_s|^2.
StokesVector transformed(const StokesVector& in, double a_p, double a_s, const core::PolarizationFrame& out) {
  const double p = a_p * a_p * 0.5 * (in.I + in.Q);
  const double s = a_s * a_s * 0.5 * (in.I - in.Q);
  const double scale = in.I / (p + s);
  const double cross = a_p * a_s * scale;
  return {in.I, (p - s) * scale, cross * in.U, cross * in.V, out};
}

/// Both amplitudes keep their size: U + iV turns by the difference of the phases, r_p conj(r_s).
StokesVector totally_reflected(const StokesVector& in, const core::FresnelFace& face,
                               const core::PolarizationFrame& out) {
  const double re = face.r_p.real() * face.r_s.real() + face.r_p.imag() * face.r_s.imag();
  const double im = face.r_p.imag() * face.r_s.real() - face.r_p.real() * face.r_s.imag();
  return {in.I, in.Q, re * in.U - im * in.V, re * in.V + im * in.U, out};
}

/// diag-like Mueller matrix of amplitudes (tangential count: p first, s second).
core::MuellerMatrix amplitude_matrix(std::complex<double> a_p, std::complex<double> a_s, double power) {
  core::MuellerMatrix M = core::MuellerMatrix::Zero();
  M(0, 0) = M(1, 1) = 0.5 * (std::norm(a_p) + std::norm(a_s)) * power;
  M(0, 1) = M(1, 0) = 0.5 * (std::norm(a_p) - std::norm(a_s)) * power;
  const std::complex<double> c = a_p * std::conj(a_s) * power;
  M(2, 2) = M(3, 3) = c.real();
  M(3, 2) = c.imag();
  M(2, 3) = -c.imag();
  return M;
}

/// Conjugates with diag(1, 1, in, in) and diag(1, 1, out, out): from right-handed frames to the tangential count.
core::MuellerMatrix in_tangential_count(core::MuellerMatrix M, double in_sign, double out_sign) {
  M.rightCols<2>() *= in_sign;
  M.bottomRows<2>() *= out_sign;
  return M;
}

}  // namespace

std::optional<BsdfSample> DielectricFace::sample(const StokesVector& incident, core::PhotonRng& rng) const {
  const Vec3& k = incident.frame.k;
  const bool upward = k.z() > 0.0;
  const double n1 = upward ? n_below_ : n_above_;
  const double n2 = upward ? n_above_ : n_below_;
  const core::FresnelFace face = core::fresnel(std::abs(k.z()), n1, n2);
  const PlaneNormal s(k);
  const StokesVector in = seen_along(incident, s);
  const auto reflected_frame = s.frame({k.x(), k.y(), -k.z()});
  if (face.total_reflection) return BsdfSample{totally_reflected(in, face, reflected_frame), true};
  const double p_re = face.r_p.real();
  const double s_re = face.r_s.real();
  const double R_p = p_re * p_re;
  const double R_s = s_re * s_re;
  const double reflected = 0.5 * (R_p * (in.I + in.Q) + R_s * (in.I - in.Q));
  if (rng.uniform() * in.I < reflected) {
    return BsdfSample{transformed(in, p_re, s_re, reflected_frame), true};
  }
  // A unit vector to rounding, as k is: its tangential part obeys Snell, its normal part comes from the same sine.
  const double bend = n1 / n2;
  const Vec3 refracted(k.x() * bend, k.y() * bend, std::copysign(face.cos_transmitted, k.z()));
  return BsdfSample{transformed(in, face.t_p, face.t_s, s.frame(refracted)), true};
}

StokesVector DielectricFace::evaluate(const StokesVector&, const Vec3& k_out) const {
  return StokesVector::unpolarized(0.0, core::PolarizationFrame::any(k_out));
}

Bsdf::Specular DielectricFace::specular(const Vec3& k) const {
  const bool upward = k.z() > 0.0;
  const core::FresnelFace face =
      core::fresnel(std::abs(k.z()), upward ? n_below_ : n_above_, upward ? n_above_ : n_below_);
  // with_e2(k, z x h) has e1 = (z x h) x k = tangential e1 for k.z > 0 and its opposite for k.z < 0; the Mueller matrix
  // does not see the sign of both axes, so only the handedness of the count remains.
  const double sign = upward ? 1.0 : -1.0;
  return {in_tangential_count(amplitude_matrix(face.t_p, face.t_s, face.transmitted_power), sign, sign),
          in_tangential_count(amplitude_matrix(face.r_p, face.r_s, 1.0), sign, -sign)};
}

Bsdf::Specular incoherent_sheet(double cos_incident, double n, double absorption, double thickness) {
  const core::FresnelFace in = core::fresnel(cos_incident, 1.0, n);
  const double a = std::exp(-absorption * thickness / in.cos_transmitted);
  // r of the inner faces is -r of the outer one; products of two of them carry no sign. t t' = 1 - r^2 (Stokes
  // relations).
  const auto through = [&](double rr, double tt) { return tt * tt * a / (1.0 - rr * rr * a * a); };
  const double rs = in.r_s.real();
  const double rp = in.r_p.real();
  const double Ts = through(rs * rs, 1.0 - rs * rs);
  const double Tp = through(rp * rp, 1.0 - rp * rp);
  const double cross_t = in.t_s * in.t_p * in.transmitted_power;  // t_s t_p of one face times the power factor
  const double Tc = cross_t * cross_t * a / (1.0 - rs * rp * rs * rp * a * a);
  const double Rs = rs * rs * (1.0 + a * Ts);
  const double Rp = rp * rp * (1.0 + a * Tp);
  const double Rc = rs * rp * (1.0 + a * Tc);
  const auto matrix = [](double p, double s, double c) {
    core::MuellerMatrix M = core::MuellerMatrix::Zero();
    M(0, 0) = M(1, 1) = 0.5 * (p + s);
    M(0, 1) = M(1, 0) = 0.5 * (p - s);
    M(2, 2) = M(3, 3) = c;
    return M;
  };
  // Reflection in the tangential count: r_p / r_s = -1 at normal incidence becomes +1.
  return {matrix(Tp, Ts, Tc), matrix(Rp, Rs, -Rc)};
}

}  // namespace evenglow::tracer
