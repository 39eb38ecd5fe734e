#include "tracer/optics/dielectric_face.h"

#include <cmath>
#include <complex>

#include "core/light/fresnel.h"

namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

/// Unit vector normal to the plane of incidence: z x h, with h = +x at normal incidence.
Vec3 s_axis(const Vec3& k) {
  const double sin2 = k.x() * k.x() + k.y() * k.y();
  if (sin2 < 1e-18) return Vec3::UnitY();
  const double inverse = 1.0 / std::sqrt(sin2);
  return {-k.y() * inverse, k.x() * inverse, 0.0};
}

/// Light with amplitudes E_p' = a_p E_p, E_s' = a_s E_s, rescaled to power `I`; incident Q = |E_p|^2 - |E_s|^2.
StokesVector transformed(const StokesVector& in, std::complex<double> a_p, std::complex<double> a_s,
                         const core::PolarizationFrame& out) {
  const double p = std::norm(a_p) * 0.5 * (in.I + in.Q);
  const double s = std::norm(a_s) * 0.5 * (in.I - in.Q);
  const std::complex<double> uv = a_p * std::conj(a_s) * std::complex<double>(in.U, in.V);
  const double scale = in.I / (p + s);
  return {in.I, (p - s) * scale, uv.real() * scale, uv.imag() * scale, out};
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
  const Vec3 s = s_axis(k);
  const StokesVector in = incident.in_frame(s.cross(k));
  const Vec3 mirrored(k.x(), k.y(), -k.z());
  const auto reflected_frame = core::PolarizationFrame::with_e2(mirrored, s);
  if (face.total_reflection) return BsdfSample{transformed(in, face.r_p, face.r_s, reflected_frame), true};
  const double reflected = 0.5 * (face.reflectance_p() * (in.I + in.Q) + face.reflectance_s() * (in.I - in.Q));
  if (rng.uniform() * in.I < reflected) {
    return BsdfSample{transformed(in, face.r_p, face.r_s, reflected_frame), true};
  }
  const double bend = n1 / n2;
  const Vec3 refracted = Vec3(k.x() * bend, k.y() * bend, std::copysign(face.cos_transmitted, k.z())).normalized();
  return BsdfSample{transformed(in, face.t_p, face.t_s, core::PolarizationFrame::with_e2(refracted, s)), true};
}

StokesVector DielectricFace::evaluate(const StokesVector&, const Vec3& k_out) const {
  return StokesVector::unpolarized(0.0, core::PolarizationFrame::any(k_out));
}

Bsdf::Specular DielectricFace::specular(const Vec3& k) const {
  const bool upward = k.z() > 0.0;
  const core::FresnelFace face =
      core::fresnel(std::abs(k.z()), upward ? n_below_ : n_above_, upward ? n_above_ : n_below_);
  // with_e2(k, z x h) has e1 = (z x h) x k = tangential e1 for k.z > 0 and its opposite for k.z < 0; the Mueller matrix does
  // not see the sign of both axes, so only the handedness of the count remains.
  const double sign = upward ? 1.0 : -1.0;
  return {in_tangential_count(amplitude_matrix(face.t_p, face.t_s, face.transmitted_power), sign, sign),
          in_tangential_count(amplitude_matrix(face.r_p, face.r_s, 1.0), sign, -sign)};
}

Bsdf::Specular incoherent_sheet(double cos_incident, double n, double absorption, double thickness) {
  const core::FresnelFace in = core::fresnel(cos_incident, 1.0, n);
  const double a = std::exp(-absorption * thickness / in.cos_transmitted);
  // r of the inner faces is -r of the outer one; products of two of them carry no sign. t t' = 1 - r^2 (Stokes relations).
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
