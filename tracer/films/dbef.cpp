#include "tracer/films/dbef.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {

using core::StokesVector;
using core::Vec3;

/// A direction in the tangential count (`tangential_frame`), in plain numbers: small matrices as temporaries would cost
/// a third of a sample.
struct TabulatedDbef::Ray {
  double sign = 1.0;  ///< of k.z
  double sine = 0.0;  ///< of the angle to the normal
  double cosine = 1.0;
  double azimuth_x = 1.0, azimuth_y = 0.0;

  explicit Ray(const Vec3& k) : sign(k.z() >= 0.0 ? 1.0 : -1.0), cosine(std::abs(k.z())) {
    const double sine2 = k.x() * k.x() + k.y() * k.y();
    if (sine2 <= 1e-18) return;  // the azimuth is noise
    sine = std::sqrt(sine2);
    const double inverse = 1.0 / sine;
    azimuth_x = k.x() * inverse;
    azimuth_y = k.y() * inverse;
  }

  Vec3 e1() const { return {azimuth_x * cosine, azimuth_y * cosine, -sign * sine}; }
  /// The film axis from the tangential direction.
  double cos_psi(const core::Vec2& axis) const { return axis.x() * azimuth_x + axis.y() * azimuth_y; }
  double sin_psi(const core::Vec2& axis) const { return axis.y() * azimuth_x - axis.x() * azimuth_y; }
};

/// Incident light as the film sees it.
struct TabulatedDbef::Incidence {
  Ray ray;
  double psi = 0.0;           ///< rad in [0, pi)
  double cos2_sigma = 1.0;    ///< cos^2 of the angle of incidence
  double q1 = 0.0, q2 = 0.0;  ///< Q, U over I from the film's axis
  double v = 0.0;             ///< V / I
};

/// Light in the tangential count.
struct TabulatedDbef::Light {
  double I = 0.0, Q = 0.0, U = 0.0, V = 0.0;

  void add(const Light& other, double weight) {
    I += weight * other.I;
    Q += weight * other.Q;
    U += weight * other.U;
    V += weight * other.V;
  }
  StokesVector stokes(const Ray& ray, const Vec3& k, double scale) const {
    return {I * scale, Q * scale, ray.sign * U * scale, ray.sign * V * scale, {k, ray.e1()}};
  }
};

TabulatedDbef::TabulatedDbef(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                             double axis)
    : bsdf_(table, wavelength_nm, hemispherical, kDbefIndex), axis_(std::cos(axis), std::sin(axis)) {}

TabulatedDbef::Incidence TabulatedDbef::incidence(const StokesVector& light) const {
  Incidence in{Ray(light.frame.k)};
  const Vec3& e1 = light.frame.e1;
  const double c = in.ray.cos_psi(axis_);
  const double s = in.ray.sin_psi(axis_);
  in.psi = bsdf_.incidences().psi_of(c, s);
  in.cos2_sigma = light.frame.k.z() * light.frame.k.z();
  // The light's frame turned to the tangential one (cosine and sine of the angle), and that to the film's axis.
  const double turn_c = e1.dot(in.ray.e1());
  const double turn_s = in.ray.sign * (in.ray.azimuth_y * e1.x() - in.ray.azimuth_x * e1.y());
  const double scale = 1.0 / light.I;
  const double c2 = turn_c * turn_c - turn_s * turn_s, s2 = 2.0 * turn_c * turn_s;
  const double Q = (light.Q * c2 + light.U * s2) * scale;
  const double U = in.ray.sign * (light.U * c2 - light.Q * s2) * scale;
  const double film_c2 = c * c - s * s, film_s2 = 2.0 * c * s;
  in.q1 = Q * film_c2 + U * film_s2;
  in.q2 = U * film_c2 - Q * film_s2;
  in.v = in.ray.sign * light.V * scale;
  return in;
}

/// Unit vector (x, y) among (q1, q2) of the axis that is called tau_min's, D = tau_max - tau_min along it, and the
/// product of the amplitudes of both axes. No branches on what is random from photon to photon.
struct TabulatedDbef::Lobe {
  double S = 0.0, D = 0.0, x = 1.0, y = 0.0, cross = 0.0;
};

TabulatedDbef::Lobe TabulatedDbef::lobe(const SampledBsdf::Response& response, ScatterKind kind) const {
  const double side = 1.0 - 2.0 * static_cast<double>(kind);
  const double square = response.x * response.x + response.y * response.y;
  const double length = std::sqrt(square);
  Lobe lobe{response.S, std::copysign(length, response.x * side + 0.0), side, 0.0, 0.0};
  if (length > 0.0) {
    const double inverse = 1.0 / lobe.D;
    lobe.x = response.x * inverse;
    lobe.y = response.y * inverse;
  }
  lobe.cross = response.kappa * 0.5 * std::sqrt(std::max(0.0, response.S * response.S - square));
  return lobe;
}

/// Light in the outgoing tangential count per unit incident power, in the unit of `response`.
TabulatedDbef::Light TabulatedDbef::outgoing(const Incidence& in, const SampledBsdf::Response& response,
                                             ScatterKind kind, const Ray& out) const {
  const double side = 1.0 - 2.0 * static_cast<double>(kind);
  const Lobe l = lobe(response, kind);
  const double along = l.x * in.q1 + l.y * in.q2;
  const double across = l.x * in.q2 - l.y * in.q1;
  const double Q = 0.5 * (l.S * along - l.D);
  const double U = l.cross * across;
  const AxisAngle pass = pass_axis(out.cos_psi(axis_), out.sin_psi(axis_), out.sine, kDbefIndex);
  const AxisAngle chi{side * pass.cos2, side * pass.sin2};  // transmission: 90 degrees further, the block axis
  return {0.5 * (l.S - l.D * along), Q * chi.cos2 - U * chi.sin2, Q * chi.sin2 + U * chi.cos2, l.cross * in.v};
}

std::optional<BsdfSample> TabulatedDbef::sample(const StokesVector& incident, core::PhotonRng& rng) const {
  const Incidence in = incidence(incident);
  const std::size_t node = bsdf_.incidences().draw(in.psi, in.cos2_sigma, rng.uniform());
  bsdf_.prefetch(node);
  if (rng.uniform() >= bsdf_.integral(node).power(in.q1, in.q2)) return std::nullopt;
  const SampledBsdf::Draw d = bsdf_.draw(node, in.q1, in.q2, rng);

  const double sine = in.ray.sine;
  const double way = d.u * d.u * horizon_distance(sine, in.cos2_sigma, d.cos_phi, d.sin_phi);
  const double bx = sine + way * d.cos_phi;
  const double by = way * d.sin_phi;
  // 1 - beta^2 without the difference of near-equal numbers; a ray in the horizon itself would never leave the film.
  const double cos2_out = in.cos2_sigma - way * (2.0 * sine * d.cos_phi + way);
  const double cos_out = std::sqrt(std::max(cos2_out, 1e-18));
  const double side = in.ray.sign * (2.0 * static_cast<double>(d.kind) - 1.0);
  const Vec3 k(bx * in.ray.azimuth_x - by * in.ray.azimuth_y, bx * in.ray.azimuth_y + by * in.ray.azimuth_x,
               side * cos_out);  // of length 1 to rounding
  const Ray out(k);
  const Light light = outgoing(in, d.response, d.kind, out);
  return BsdfSample{light.stokes(out, k, incident.I / light.I), false};
}

/// Where the tables hold the response of one ray for another.
struct TabulatedDbef::Way {
  ScatterKind kind = ScatterKind::reflection;
  double r = 0.0;  ///< to the horizon; 0: nothing goes there
  double u = 0.0, phi = 0.0, cos_phi = 1.0, sin_phi = 0.0;
};

TabulatedDbef::Way TabulatedDbef::way(const Ray& in, const Ray& out, const Vec3& k_out) const {
  Way to;
  to.kind = in.sign * out.sign > 0.0 ? ScatterKind::transmission : ScatterKind::reflection;
  const double bx = k_out.x() * in.azimuth_x + k_out.y() * in.azimuth_y - in.sine;
  const double by = k_out.y() * in.azimuth_x - k_out.x() * in.azimuth_y;
  const double length = std::sqrt(bx * bx + by * by);
  if (length > 0.0) {
    to.cos_phi = bx / length;
    to.sin_phi = by / length;
  }
  to.r = horizon_distance(in.sine, in.cosine * in.cosine, to.cos_phi, to.sin_phi);
  if (to.r > 0.0) {
    to.u = std::sqrt(length / to.r);
    to.phi = full_angle(to.sin_phi, to.cos_phi);
  }
  return to;
}

StokesVector TabulatedDbef::evaluate(const StokesVector& incident, const Vec3& k_out) const {
  const Incidence in = incidence(incident);
  const Ray out(k_out);
  const Way to = way(in.ray, out, k_out);
  Light sum;
  if (to.r > 0.0) {
    const IncidenceGrid::Cell cell = bsdf_.incidences().cell(in.psi, in.cos2_sigma);
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.weight[i] == 0.0) continue;
      const SampledBsdf::Response response =
          bsdf_.response(cell.node[i], to.kind, to.u, to.phi, to.cos_phi, to.sin_phi);
      sum.add(outgoing(in, response, to.kind, out), cell.weight[i]);
    }
  }
  return sum.stokes(out, k_out, to.r > 0.0 ? incident.I / (to.r * to.r) : 0.0);
}

StokesVector TabulatedDbef::pulled_back(const StokesVector& importance, const Vec3& k_in) const {
  const Ray in(k_in), out(importance.frame.k);
  const Way to = way(in, out, importance.frame.k);
  const core::PolarizationFrame frame{k_in, in.e1()};
  if (!(to.r > 0.0)) return StokesVector::unpolarized(0.0, frame);
  // The importance in the outgoing tangential count, its Q and U from the axis that the outgoing light is polarized
  // along.
  const StokesVector w = importance.in_frame(out.e1());
  const AxisAngle pass = pass_axis(out.cos_psi(axis_), out.sin_psi(axis_), out.sine, kDbefIndex);
  const double side = 1.0 - 2.0 * static_cast<double>(to.kind);
  const double w_u = out.sign * w.U, w_v = out.sign * w.V;
  const double w_a = side * (w.Q * pass.cos2 + w_u * pass.sin2);
  const double w_b = side * (w_u * pass.cos2 - w.Q * pass.sin2);
  // `outgoing` is linear in (1, q1, q2, v): what each of them brings.
  const double c = in.cos_psi(axis_), s = in.sin_psi(axis_);
  double natural = 0.0, q1 = 0.0, q2 = 0.0, v = 0.0;
  const IncidenceGrid::Cell cell = bsdf_.incidences().cell(bsdf_.incidences().psi_of(c, s), in.cosine * in.cosine);
  for (std::size_t i = 0; i < 4; ++i) {
    if (cell.weight[i] == 0.0) continue;
    const Lobe l = lobe(bsdf_.response(cell.node[i], to.kind, to.u, to.phi, to.cos_phi, to.sin_phi), to.kind);
    const double along = 0.5 * (w_a * l.S - w.I * l.D), across = w_b * l.cross;
    natural += cell.weight[i] * 0.5 * (w.I * l.S - w_a * l.D);
    q1 += cell.weight[i] * (along * l.x - across * l.y);
    q2 += cell.weight[i] * (along * l.y + across * l.x);
    v += cell.weight[i] * w_v * l.cross;
  }
  const double scale = 1.0 / (to.r * to.r);
  const double film_c2 = c * c - s * s, film_s2 = 2.0 * c * s;
  return {natural * scale, (q1 * film_c2 - q2 * film_s2) * scale, in.sign * (q1 * film_s2 + q2 * film_c2) * scale,
          in.sign * v * scale, frame};
}

double TabulatedDbef::hemispherical(const StokesVector& incident, ScatterKind kind) const {
  const Incidence in = incidence(incident);
  const IncidenceGrid::Cell cell = bsdf_.incidences().cell(in.psi, in.cos2_sigma);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    sum += cell.weight[i] * bsdf_.integral(cell.node[i], kind).power(in.q1, in.q2);
  }
  return sum;
}

}  // namespace evenglow::tracer
