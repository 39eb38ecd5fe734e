#include "tracer/microstructure/printed_dot.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tracer {

using core::StokesVector;
using core::Vec3;

TranslucentDot::TranslucentDot(double reflectance, double specular, double transmittance, double plate_index)
    : mirrored_(reflectance * specular) {
  const double out = transmittance / (plate_index * plate_index);
  outside_ = {reflectance - mirrored_, transmittance};
  inside_ = {reflectance - mirrored_ + (transmittance - out), out};
}

std::optional<BsdfSample> TranslucentDot::sample(const StokesVector& incident, core::PhotonRng& rng) const {
  const Shares& share = shares(incident.frame.k);
  const double u = rng.uniform();
  if (u >= mirrored_ + share.diffuse + share.transmitted) return std::nullopt;
  if (u < mirrored_) return BsdfSample{mirrored(incident), true};
  const bool passes = u >= mirrored_ + share.diffuse;
  const double u1 = rng.uniform();
  Vec3 k = core::sample_lambertian(u1, rng.uniform());
  if ((incident.frame.k.z() > 0.0) != passes) k.z() = -k.z();
  return BsdfSample{StokesVector::unpolarized(incident.I, core::PolarizationFrame::any(k)), false};
}

StokesVector TranslucentDot::evaluate(const StokesVector& incident, const Vec3& k_out) const {
  const Shares& share = shares(incident.frame.k);
  const bool passes = incident.frame.k.z() * k_out.z() > 0.0;
  const double f = (passes ? share.transmitted : share.diffuse) / core::kPi;
  return StokesVector::unpolarized(f * incident.I, core::PolarizationFrame::any(k_out));
}

Bsdf::Specular TranslucentDot::specular(const Vec3&) const {
  return {core::MuellerMatrix::Zero(), core::MuellerMatrix::Identity() * mirrored_};
}

Microstructure make_printed_dot(const core::ConfigNode& node) {
  constexpr core::Range kShare = core::Range::closed(0, 1);
  const double reflectance = node.number({"reflectance", "reflectance of the white ink", kShare, 0.95});
  const double specular = node.number(
      {"specular_share", "share of the reflected light that is mirrored and keeps its polarization", kShare, 0.0});
  double transmittance =
      node.number({"transmittance", "share that the ink passes diffusely, counted from the air", kShare, 0.0});
  if (reflectance + transmittance > 1.0 + 1e-12) {
    node.fault_at("transmittance", fmt::format("must not exceed {:g} with the reflectance {:g}, got {:g}",
                                               1.0 - reflectance, reflectance, transmittance));
    transmittance = 1.0 - reflectance;
  }
  return {"printed_dot", [=](double plate_index) -> std::unique_ptr<const Bsdf> {
            if (transmittance == 0.0) return std::make_unique<OpaqueReflector>(reflectance, specular);
            return std::make_unique<TranslucentDot>(reflectance, specular, transmittance, plate_index);
          }};
}

}  // namespace evenglow::tracer
