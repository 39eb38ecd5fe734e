#pragma once

#include "tracer/films/film.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {

/// A whole sheet with smooth faces that scatters in its bulk, in air, as one surface without thickness or width: what
/// a photon meets in the sheet is traced face by face and scatter by scatter until it leaves or is absorbed, and where
/// it leaves is not told. For looking at a sheet by itself (film sweeps); in a backlight the scene traces its body.
///
/// `specular` tells the light that is not scattered, with the extinction exp(-(absorption + scattering) way) in
/// between the faces.
class ScatteringSheet final : public Bsdf {
 public:
  /// Light still inside after so many scatters and faces counts as absorbed.
  static constexpr int kMaxEvents = 1'000'000;

  /// A promise: `sheet.scattering` is there and its coefficient above 0.
  explicit ScatteringSheet(const DielectricSheet& sheet);

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return false; }
  bool redirects() const override { return true; }
  Specular specular(const core::Vec3& k) const override;

 private:
  DielectricSheet sheet_;
  DielectricFace bottom_, top_;
};

}  // namespace evenglow::tracer
