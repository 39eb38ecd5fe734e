#pragma once

#include "tracer/optics/bsdf.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {

/// A film that neither scatters nor bends light: all it does is told by two Mueller matrices for each incidence.
class SpecularFilm : public Bsdf {
 public:
  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return false; }
  Specular specular(const core::Vec3& k) const override { return matrices(tangential_frame(k)); }

 private:
  /// Between tangential frames, for the ray of this frame; physical, and T + R at most 1 for every polarization.
  virtual Specular matrices(const TangentialFrame& frame) const = 0;
};

/// R(-chi) M R(chi): what M does in axes along chi, seen from the tangential frame that chi is counted in.
core::MuellerMatrix turned(const core::MuellerMatrix& M, const AxisAngle& chi);

}  // namespace evenglow::tracer
