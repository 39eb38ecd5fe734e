#pragma once

#include <optional>

#include "tracer/films/abg_lobe.h"
#include "tracer/films/symmetric_lobe.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A thin diffuser, the same from both sides and for every incidence: of the incident power the share `transmittance`
/// passes and the share `reflectance` comes back. Of what passes, the share `haze` is scattered and the rest goes
/// straight on unchanged (haze as in ASTM D1003, but of all scattered light); what comes back is scattered about the
/// specular direction.
///
/// Gaussian lobe: `SymmetricLobe`; ABg lobe: `AbgLobe`; Lambertian: radiance the same in all directions of the
/// hemisphere.
/// Scattered light keeps its polarization but for `depolarization` d: (Q, U, V) are carried along the shortest turn
/// from the unscattered ray (straight or mirrored) to the outgoing one and multiplied by 1 - d. That turn is what
/// refraction or reflection at small tilted facets does as long as they treat s and p alike; carrying Q and U between
/// tangential frames instead would turn the polarization with the azimuth of the outgoing ray even for scatter by a
/// fraction of a degree.
class Diffuser final : public Bsdf {
 public:
  struct Spec {
    double transmittance = 0.9;
    double reflectance = 0.1;
    double haze = 1.0;
    std::optional<double> fwhm{};  ///< rad: full width at half maximum of the luminance of the lobe in air at normal
                                   ///< incidence (before the scaling c); none: Lambertian, or `abg`
    double depolarization = 0.0;
    struct Abg {
      double b = 0.0, g = 0.0;
    };
    std::optional<Abg> abg{};  ///< instead of `fwhm`
  };
  /// T, R, haze, d in [0, 1], T + R <= 1, fwhm in [1, 150] degrees, B and g as of `AbgLobe`; `core::Error`
  /// otherwise.
  explicit Diffuser(const Spec& spec);

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return spec_.reflectance > 0.0 || spec_.transmittance * spec_.haze > 0.0; }
  Specular specular(const core::Vec3& k) const override;

  /// Width s of the Gaussian in direction cosines with this full width at half maximum: sin(fwhm / 2) / sqrt(2 ln 2).
  static double lobe_width(double fwhm);

  const Spec& spec() const { return spec_; }
  /// Direction of scattered light on the side of `unscattered`, the ray straight on or mirrored.
  core::Vec3 draw_direction(const core::Vec3& unscattered, core::PhotonRng& rng) const;

 private:
  Spec spec_;
  std::optional<SymmetricLobe> lobe_;
  std::optional<AbgLobe> abg_;
};

/// Light scattered towards `k_out` (of the power of `incident`): the unscattered ray, straight on or mirrored, is
/// turned by the shortest way and its Q, U, V multiplied by 1 - depolarization.
core::StokesVector scattered_light(const core::StokesVector& incident, const core::Vec3& k_out, double depolarization);

}  // namespace evenglow::tracer
