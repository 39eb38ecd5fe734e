#include "tracer/films/mueller_film.h"

#include <cmath>

#include "core/base/units.h"
#include "tracer/films/dbef.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

/// Linear polarization counted from an axis at the angle whose cosine and sine are given: Q, U turned by it.
Eigen::Vector4d counted_from(const Eigen::Vector4d& s, double cosine, double sine) {
  const double c2 = cosine * cosine - sine * sine;
  const double s2 = 2.0 * cosine * sine;
  return {s[0], s[1] * c2 + s[2] * s2, s[2] * c2 - s[1] * s2, s[3]};
}

}  // namespace

/// Incident light as the film sees it.
struct TabulatedMueller::Incidence {
  TangentialFrame frame;
  double psi = 0.0;         ///< rad in [0, pi)
  double cos2_sigma = 1.0;  ///< cos^2 of the angle of incidence
  Eigen::Vector4d s;        ///< counted from the film's axis, unit power
};

TabulatedMueller::TabulatedMueller(const MuellerTable& table, double wavelength_nm,
                                   const HemisphericalTable* hemispherical, double axis)
    : bsdf_(table, wavelength_nm, hemispherical, kDbefIndex), axis_(axis) {}

TabulatedMueller::Incidence TabulatedMueller::incidence(const core::StokesVector& incident) const {
  Incidence in;
  in.frame = tangential_frame(incident.frame.k);
  const double c = axis_.cos_psi(in.frame);
  const double s = axis_.sin_psi(in.frame);
  in.psi = std::atan2(s, c);
  if (in.psi < 0.0) in.psi += core::kPi;
  in.cos2_sigma = incident.frame.k.z() * incident.frame.k.z();
  in.s = counted_from(to_film(incident, in.frame) / incident.I, c, s);
  return in;
}

std::optional<BsdfSample> TabulatedMueller::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const Incidence in = incidence(incident);
  const std::size_t node = bsdf_.incidences().draw(in.psi, in.cos2_sigma, rng.uniform());
  if (rng.uniform() >= bsdf_.integral(node).dot(in.s)) return std::nullopt;
  const SampledMueller::Draw d = bsdf_.draw(node, in.s, rng);

  const double sin_in = in.frame.sin_polar;
  const double way = d.u * d.u * horizon_distance(sin_in, in.cos2_sigma, d.cos_phi, d.sin_phi);
  const double bx = sin_in + way * d.cos_phi;
  const double by = way * d.sin_phi;
  // 1 - beta^2 without the difference of near-equal numbers; a ray in the horizon itself would never leave the film.
  const double cos2_out = in.cos2_sigma - way * (2.0 * sin_in * d.cos_phi + way);
  const double cos_out = std::sqrt(std::max(cos2_out, 1e-18));
  const bool upwards = (incident.frame.k.z() > 0.0) == (d.kind == ScatterKind::transmission);
  const core::Vec3 k = core::Vec3(bx * in.frame.azimuth_cos - by * in.frame.azimuth_sin,
                                  bx * in.frame.azimuth_sin + by * in.frame.azimuth_cos, upwards ? cos_out : -cos_out)
                           .normalized();
  const core::StokesVector out = evaluate(incident, k);
  // Rounding may leave nothing of a power that was drawn: light without polarization then.
  if (!(out.I > 0.0)) return BsdfSample{core::StokesVector::unpolarized(incident.I, out.frame), false};
  core::StokesVector light = out.scaled(incident.I / out.I);
  light.I = incident.I;
  return BsdfSample{light, false};
}

core::StokesVector TabulatedMueller::evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const {
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
      if (cell.weight[i] > 0.0) sum += cell.weight[i] * (bsdf_.response(cell.node[i], kind, u, phi) * in.s);
    }
    sum *= incident.I / (r * r);
  }
  // The tables are single precision: their rounding must not make light more than fully polarized.
  sum[0] = std::max(sum[0], 0.0);
  const double polarized = sum.tail<3>().norm();
  if (polarized > sum[0]) sum.tail<3>() *= sum[0] / polarized;
  return from_film(counted_from(sum, axis_.cos_psi(out), -axis_.sin_psi(out)), out);
}

double TabulatedMueller::hemispherical(const core::StokesVector& incident, ScatterKind kind) const {
  const Incidence in = incidence(incident);
  const IncidenceGrid::Cell cell = bsdf_.incidences().cell(in.psi, in.cos2_sigma);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += cell.weight[i] * bsdf_.integral(cell.node[i], kind).dot(in.s);
  return sum;
}

}  // namespace evenglow::tracer
