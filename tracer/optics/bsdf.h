#pragma once

#include <optional>

#include "core/light/mueller.h"
#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {

/// Light that leaves a surface after one interaction.
struct BsdfSample {
  core::StokesVector
      light;  ///< direction in light.frame.k; I equals that of the incident light (the share is in the odds)
  bool specular = false;  ///< a direction of its own (mirror, straight passage): `evaluate` does not hold it
};

/// What a surface does to polarized light, in the surface's own frame: normal +z, x the reference axis of a film (laid
/// along the plate's x before it is turned by axis_deg). Light that travels with k.z > 0 comes from below (-z side).
/// Directions of both incident and outgoing light are directions of travel.
///
/// Analog: `sample` returns light of the same power with the odds of the outcome, or nothing if it was absorbed. So the
/// energy account is a count of photons.
class Bsdf {
 public:
  virtual ~Bsdf() = default;

  /// Draws the outcome for incident light of I > 0; empty: absorbed.
  virtual std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const = 0;

  /// Expected light per unit solid angle towards `k_out` (1/sr times the incident unit), cosine of the outgoing ray
  /// NOT included: L(k_out) = f E. Non-specular part only. Zero power if there is none.
  virtual core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const = 0;

  /// Density (1/sr) with which `sample` chooses `k_out` among non-specular outcomes: first component of `evaluate` for
  /// unit power, times |cos| of the outgoing ray. Integrates to 1 - absorbed - specular.
  double pdf(const core::StokesVector& incident, const core::Vec3& k_out) const {
    return evaluate(incident, k_out).I / incident.I * std::abs(k_out.z());
  }

  /// Has it a non-specular part?
  virtual bool scatters() const = 0;

  /// Does it send light into directions of its own that neither `evaluate` nor `specular` tells (a prism film)? What
  /// such a surface sends to a viewer can only be counted.
  virtual bool redirects() const { return false; }

  /// Specular transmission and reflection of light that travels along k, as Mueller matrices between tangential frames
  /// (`tangential_frame`). Zero where there is none.
  struct Specular {
    core::MuellerMatrix transmission = core::MuellerMatrix::Zero();
    core::MuellerMatrix reflection = core::MuellerMatrix::Zero();
  };
  virtual Specular specular(const core::Vec3& k) const = 0;
};

/// The frame that film data are counted in (configs/data/README.md): e1 in the plane of the ray and the normal z, its
/// tangential part along that of k (h; +x at normal incidence); U and V are then counted towards z x h, which is e2 for
/// k.z > 0 and -e2 for k.z < 0. `k` unit.
struct TangentialFrame {
  core::PolarizationFrame frame;  ///< right-handed, as everywhere
  double sign = 1.0;              ///< multiplies U and V between the right-handed frame and the film's count
  double azimuth_cos = 1.0;       ///< h = (azimuth_cos, azimuth_sin, 0)
  double azimuth_sin = 0.0;
  double sin_polar = 0.0;  ///< of the angle between ray and normal
};
TangentialFrame tangential_frame(const core::Vec3& k);

/// Light as a 4-vector in the film's count, and back.
Eigen::Vector4d to_film(const core::StokesVector& light, const TangentialFrame& frame);
core::StokesVector from_film(const Eigen::Vector4d& s, const TangentialFrame& frame);

}  // namespace evenglow::tracer
