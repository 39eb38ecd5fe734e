#include "tracer/optics/opaque_reflector.h"

#include "core/base/units.h"
#include "core/math/sampling.h"

namespace evenglow::tracer {

core::StokesVector mirrored(const core::StokesVector& incident) {
  const core::Vec3& k = incident.frame.k;
  const core::Vec3& e1 = incident.frame.e1;
  // The field's tangential part is kept in the count: e1 is mirrored with k, and the mirror turns the handedness, so U
  // and V, counted in the new right-handed frame, change sign.
  const core::PolarizationFrame out{{k.x(), k.y(), -k.z()}, {e1.x(), e1.y(), -e1.z()}};
  return {incident.I, incident.Q, -incident.U, -incident.V, out};
}

std::optional<BsdfSample> OpaqueReflector::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const double u = rng.uniform();
  if (u >= reflectance_) return std::nullopt;
  if (u < reflectance_ * specular_) return BsdfSample{mirrored(incident), true};
  const double u1 = rng.uniform();
  core::Vec3 k = core::sample_lambertian(u1, rng.uniform());
  if (incident.frame.k.z() > 0.0) k.z() = -k.z();
  return BsdfSample{core::StokesVector::unpolarized(incident.I, core::PolarizationFrame::any(k)), false};
}

core::StokesVector OpaqueReflector::evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const {
  const bool reflected = incident.frame.k.z() * k_out.z() < 0.0;
  const double f = reflected ? reflectance_ * (1.0 - specular_) / core::kPi : 0.0;
  return core::StokesVector::unpolarized(f * incident.I, core::PolarizationFrame::any(k_out));
}

Bsdf::Specular OpaqueReflector::specular(const core::Vec3&) const {
  return {core::MuellerMatrix::Zero(), core::MuellerMatrix::Identity() * (reflectance_ * specular_)};
}

}  // namespace evenglow::tracer
