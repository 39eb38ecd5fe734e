#pragma once

#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// Smooth face between two lossless media: index `n_below` on the -z side, `n_above` on the +z side. Signed Fresnel
/// amplitudes, total reflection with its phases (core/light/fresnel.h). Chooses reflection with the odds of this very
/// Stokes vector, not of natural light.
class DielectricFace final : public Bsdf {
 public:
  DielectricFace(double n_below, double n_above) : n_below_(n_below), n_above_(n_above) {}

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return false; }
  /// Transmission changes the direction; the matrices are between the tangential frames of both rays.
  Specular specular(const core::Vec3& k) const override;

 private:
  double n_below_;
  double n_above_;
};

/// Mueller matrices (tangential count) of a lossy parallel sheet in air, all orders added without interference, for
/// light at `cos_incident`: index n, absorption (1/mm), thickness (mm).
Bsdf::Specular incoherent_sheet(double cos_incident, double n, double absorption, double thickness);

}  // namespace evenglow::tracer
