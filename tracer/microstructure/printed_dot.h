#pragma once

#include "core/config/config_node.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A dot of ink that lets light through. Counted from the air, it reflects the share `reflectance`, of it the share
/// `specular` as a mirror that keeps the polarization and the rest Lambertian and unpolarized, and passes the share
/// `transmittance` on into the plate, Lambertian and unpolarized.
///
/// From inside a plate of index n, of the light that the ink scatters to its outer side only the part 1/n^2 gets out
/// (etendue; the rest is thrown back by total reflection there): the transmittance is transmittance / n^2, and the
/// difference adds to the diffuse reflectance. So radiances 1 outside and n^2 inside stay in balance.
class TranslucentDot final : public Bsdf {
 public:
  /// reflectance + transmittance <= 1, all in [0, 1]; `plate_index` >= 1.
  TranslucentDot(double reflectance, double specular, double transmittance, double plate_index);

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return true; }
  Specular specular(const core::Vec3& k) const override;

 private:
  /// Shares of the light that comes from one side.
  struct Shares {
    double diffuse;
    double transmitted;
  };
  const Shares& shares(const core::Vec3& k) const { return k.z() > 0.0 ? inside_ : outside_; }

  double mirrored_;
  Shares inside_, outside_;
};

/// Dot of white ink in optical contact with the face: light that meets it, from inside the plate or from outside, is
/// scattered back Lambertian and unpolarized. The chance of a hit is the local area coverage (Lee et al., Opt. Eng. 44,
/// 014004, 2005).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | reflectance | of the ink, 0 to 1 | 0.95 |
/// | specular_share | share of the reflected light that is mirrored and keeps its polarization | 0 |
/// | transmittance | share that passes, counted from the air (`TranslucentDot`) | 0 |
Microstructure make_printed_dot(const core::ConfigNode& node);

}  // namespace evenglow::tracer
