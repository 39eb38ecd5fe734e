#include "tracer/films/specular_film.h"

namespace evenglow::tracer {

core::MuellerMatrix turned(const core::MuellerMatrix& M, const AxisAngle& chi) {
  core::MuellerMatrix turn = core::MuellerMatrix::Identity();
  turn(1, 1) = turn(2, 2) = chi.cos2;
  turn(1, 2) = chi.sin2;
  turn(2, 1) = -chi.sin2;
  return turn.transpose() * M * turn;
}

std::optional<BsdfSample> SpecularFilm::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
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

core::StokesVector SpecularFilm::evaluate(const core::StokesVector&, const core::Vec3& k_out) const {
  return core::StokesVector::unpolarized(0.0, tangential_frame(k_out).frame);
}

}  // namespace evenglow::tracer
