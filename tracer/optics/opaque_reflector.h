#pragma once

#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// An opaque sheet that looks the same from both sides: reflects the share `reflectance`, of it the share `specular` as
/// a mirror that keeps the polarization, the rest Lambertian and depolarized (volume scatter forgets the polarization).
/// White sheets, mirrors, printed dots, LED windows and frames are of this kind.
class OpaqueReflector final : public Bsdf {
 public:
  /// Both in [0, 1].
  OpaqueReflector(double reflectance, double specular) : reflectance_(reflectance), specular_(specular) {}

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return reflectance_ > 0.0 && specular_ < 1.0; }
  Specular specular(const core::Vec3& k) const override;

  double reflectance() const { return reflectance_; }
  double specular_share() const { return specular_; }

 private:
  double reflectance_;
  double specular_;
};

/// Light reflected by an ideal mirror at z = const: the tangential count keeps its Stokes vector.
core::StokesVector mirrored(const core::StokesVector& incident);

}  // namespace evenglow::tracer
