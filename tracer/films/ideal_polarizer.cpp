#include "tracer/films/ideal_polarizer.h"

#include "core/base/error.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

/// R(-chi) D(along pass, along block) R(chi) between tangential frames.
core::MuellerMatrix turned_diattenuator(double pass, double block, const AxisAngle& chi) {
  core::MuellerMatrix turn = core::MuellerMatrix::Identity();
  turn(1, 1) = turn(2, 2) = chi.cos2;
  turn(1, 2) = chi.sin2;
  turn(2, 1) = -chi.sin2;
  return turn.transpose() * core::diattenuator(pass, block) * turn;
}

}  // namespace

IdealPolarizer::IdealPolarizer(const Powers& powers, double axis, double index)
    : powers_(powers), axis_(axis), index_(index) {
  const auto allowed = [](double t, double r) { return t >= 0.0 && r >= 0.0 && t + r <= 1.0 + 1e-12; };
  core::expects(allowed(powers.transmittance_pass, powers.reflectance_pass) &&
                    allowed(powers.transmittance_block, powers.reflectance_block),
                "a polarizer's T and R are not negative and T + R is at most 1");
}

Bsdf::Specular IdealPolarizer::matrices(const TangentialFrame& frame) const {
  const AxisAngle chi = pass_axis(axis_.cos_psi(frame), axis_.sin_psi(frame), frame.sin_polar, index_);
  Specular s;
  s.transmission = turned_diattenuator(powers_.transmittance_pass, powers_.transmittance_block, chi);
  s.reflection = powers_.keeps_reflected_state
                     ? 0.5 * (powers_.reflectance_pass + powers_.reflectance_block) * core::MuellerMatrix::Identity()
                     : turned_diattenuator(powers_.reflectance_pass, powers_.reflectance_block, chi);
  return s;
}

Bsdf::Specular IdealPolarizer::specular(const core::Vec3& k) const {
  return matrices(tangential_frame(k));
}

std::optional<BsdfSample> IdealPolarizer::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const TangentialFrame in = tangential_frame(incident.frame.k);
  const Specular split = matrices(in);
  const Eigen::Vector4d s = to_film(incident, in);
  const Eigen::Vector4d transmitted = split.transmission * s;
  double chance = rng.uniform() * incident.I;
  if (chance < transmitted[0]) {
    return BsdfSample{from_film(transmitted * (incident.I / transmitted[0]), in), true};
  }
  chance -= transmitted[0];
  const Eigen::Vector4d reflected = split.reflection * s;
  if (chance >= reflected[0]) return std::nullopt;
  const core::Vec3& k = incident.frame.k;
  const TangentialFrame out = tangential_frame(core::Vec3(k.x(), k.y(), -k.z()));
  return BsdfSample{from_film(reflected * (incident.I / reflected[0]), out), true};
}

core::StokesVector IdealPolarizer::evaluate(const core::StokesVector&, const core::Vec3& k_out) const {
  return core::StokesVector::unpolarized(0.0, tangential_frame(k_out).frame);
}

}  // namespace evenglow::tracer
