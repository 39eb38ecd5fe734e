#include "tracer/films/dbef.h"

#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {

/// Incident light as the film sees it.
struct TabulatedDbef::Incidence {
  TangentialFrame frame;
  double psi = 0.0;  ///< rad in [0, pi)
  double cos2_psi = 1.0, sin2_psi = 0.0;
  double cos2_sigma = 1.0;    ///< cos^2 of the angle of incidence
  double power = 0.0;         ///< I
  double q1 = 0.0, q2 = 0.0;  ///< Q, U over I from the film's axis
  double v = 0.0;             ///< V / I
};

TabulatedDbef::TabulatedDbef(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                             double axis)
    : bsdf_(table, wavelength_nm, hemispherical, kDbefIndex), axis_(axis) {}

TabulatedDbef::Incidence TabulatedDbef::incidence(const core::StokesVector& incident) const {
  Incidence in;
  in.frame = tangential_frame(incident.frame.k);
  const double c = axis_.cos_psi(in.frame);
  const double s = axis_.sin_psi(in.frame);
  in.cos2_psi = c * c - s * s;
  in.sin2_psi = 2.0 * c * s;
  in.psi = std::atan2(s, c);
  if (in.psi < 0.0) in.psi += core::kPi;
  in.cos2_sigma = incident.frame.k.z() * incident.frame.k.z();
  in.power = incident.I;
  const Eigen::Vector4d film = to_film(incident, in.frame) / incident.I;
  in.q1 = film[1] * in.cos2_psi + film[2] * in.sin2_psi;
  in.q2 = film[2] * in.cos2_psi - film[1] * in.sin2_psi;
  in.v = film[3];
  return in;
}

/// Stokes vector in the outgoing tangential frame per unit incident power, in the unit of `response`.
Eigen::Vector4d TabulatedDbef::outgoing(const Incidence& in, const SampledBsdf::Response& response, ScatterKind kind,
                                        const TangentialFrame& out) const {
  // Unit vector of the axis that is called tau_min's, and the signed tau_max - tau_min along it.
  const bool reflected = kind == ScatterKind::reflection;
  const bool turned = reflected ? response.x < 0.0 : response.x > 0.0;
  const double length = std::sqrt(response.x * response.x + response.y * response.y);
  const double D = turned ? -length : length;
  double ex = reflected ? 1.0 : -1.0;
  double ey = 0.0;
  if (length > 0.0) {
    ex = response.x / D;
    ey = response.y / D;
  }
  const double along = ex * in.q1 + ey * in.q2;
  const double across = ex * in.q2 - ey * in.q1;
  const double cross = response.kappa * 0.5 * std::sqrt(std::max(0.0, response.S * response.S - D * D));
  const double I = 0.5 * (response.S - D * along);
  const double Q = 0.5 * (response.S * along - D);
  const double U = cross * across;
  AxisAngle chi = pass_axis(axis_.cos_psi(out), axis_.sin_psi(out), out.sin_polar, kDbefIndex);
  if (!reflected) chi = {-chi.cos2, -chi.sin2};  // 90 degrees further: the block axis
  return {I, Q * chi.cos2 - U * chi.sin2, Q * chi.sin2 + U * chi.cos2, cross * in.v};
}

std::optional<BsdfSample> TabulatedDbef::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const Incidence in = incidence(incident);
  const std::size_t node = bsdf_.incidences().draw(in.psi, in.cos2_sigma, rng.uniform());
  if (rng.uniform() >= bsdf_.integral(node).power(in.q1, in.q2)) return std::nullopt;
  const SampledBsdf::Draw d = bsdf_.draw(node, in.q1, in.q2, rng);

  const double sin_in = in.frame.sin_polar;
  const double way = d.u * d.u * horizon_distance(sin_in, in.cos2_sigma, d.cos_phi, d.sin_phi);
  const double bx = sin_in + way * d.cos_phi;
  const double by = way * d.sin_phi;
  // 1 - beta^2 without the difference of near-equal numbers; a ray in the horizon itself would never leave the film.
  const double cos2_out = in.cos2_sigma - way * (2.0 * sin_in * d.cos_phi + way);
  const double cos_out = std::sqrt(std::max(cos2_out, 1e-18));
  const bool upwards = (incident.frame.k.z() > 0.0) == (d.kind == ScatterKind::transmission);
  const core::Vec3 k(bx * in.frame.azimuth_cos - by * in.frame.azimuth_sin,
                     bx * in.frame.azimuth_sin + by * in.frame.azimuth_cos, upwards ? cos_out : -cos_out);
  const TangentialFrame out = tangential_frame(k.normalized());
  const Eigen::Vector4d s = outgoing(in, d.response, d.kind, out);
  return BsdfSample{from_film(s * (in.power / s[0]), out), false};
}

core::StokesVector TabulatedDbef::evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const {
  const Incidence in = incidence(incident);
  const TangentialFrame out = tangential_frame(k_out);
  const bool through = (incident.frame.k.z() > 0.0) == (k_out.z() > 0.0);
  const ScatterKind kind = through ? ScatterKind::transmission : ScatterKind::reflection;
  const double bx = k_out.x() * in.frame.azimuth_cos + k_out.y() * in.frame.azimuth_sin - in.frame.sin_polar;
  const double by = k_out.y() * in.frame.azimuth_cos - k_out.x() * in.frame.azimuth_sin;
  const double way = std::hypot(bx, by);
  const double cos_phi = way > 0.0 ? bx / way : 1.0;
  const double sin_phi = way > 0.0 ? by / way : 0.0;
  const double r = horizon_distance(in.frame.sin_polar, in.cos2_sigma, cos_phi, sin_phi);
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  if (r > 0.0) {
    const double u = std::sqrt(way / r);
    const double phi = full_angle(sin_phi, cos_phi);
    const IncidenceGrid::Cell cell = bsdf_.incidences().cell(in.psi, in.cos2_sigma);
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.weight[i] == 0.0) continue;
      const SampledBsdf::Response response = bsdf_.response(cell.node[i], kind, u, phi, cos_phi, sin_phi);
      sum += cell.weight[i] * outgoing(in, response, kind, out);
    }
    sum *= in.power / (r * r);
  }
  return from_film(sum, out);
}

double TabulatedDbef::hemispherical(const core::StokesVector& incident, ScatterKind kind) const {
  const Incidence in = incidence(incident);
  const IncidenceGrid::Cell cell = bsdf_.incidences().cell(in.psi, in.cos2_sigma);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += cell.weight[i] * bsdf_.integral(cell.node[i], kind).power(in.q1, in.q2);
  }
  return sum;
}

}  // namespace evenglow::tracer
