#pragma once

#include <string>
#include <vector>

#include "tracer/optics/bsdf.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/sampled_bsdf.h"

namespace evenglow::tracer {

/// Refractive index that the pass axis of an oblique ray is counted with in the DBEF data (configs/data/README.md).
inline constexpr double kDbefIndex = 1.58;

/// Scattering reflective polarizer from a polarized BSDF table (configs/data/README.md):
///
///     M = R(-chi_o) D(tau_min, tau_max, kappa) R(delta + psi)            reflection; transmission: R(-chi_o - 90 deg)
///
/// with psi the angle of the film axis from the plane of incidence, tan chi_o = tan(psi - azimuth_o) cos sigma_o'
/// (pass_axis.h for the outgoing ray, n = 1.58), all in the tangential count. That the outgoing light is polarized
/// along the pass or block axis that its own ray sees is the rule of that data set; so is the name of the axes: tau_min
/// belongs to the pass axis in reflection and to the block axis in transmission. Where delta says otherwise (more than
/// 45 degrees off), the two have changed places and the outgoing axis has not.
///
/// The film is taken to be the same from both sides: light from below sees the mirror image.
class TabulatedDbef final : public Bsdf {
 public:
  /// `axis`: rad, from +x towards +y. Without `hemispherical` the table's own integrals count (see `SampledBsdf`).
  TabulatedDbef(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical, double axis);

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return true; }
  Specular specular(const core::Vec3&) const override { return {}; }

  /// The importance (tracer/transport/reversed_bsdf.h) at `k_in` of light that leaves along `importance.frame.k`: M^T w
  /// (1/sr) for the matrix M of `evaluate`. As much work as one call of it, where the matrix would take four.
  core::StokesVector pulled_back(const core::StokesVector& importance, const core::Vec3& k_in) const;

  /// Share of the incident power that is reflected (transmitted) into the hemisphere.
  double hemispherical(const core::StokesVector& incident, ScatterKind kind) const;

  /// How the table was changed to make it usable, one sentence each.
  const std::vector<std::string>& remarks() const { return bsdf_.remarks(); }
  const SampledBsdf& tables() const { return bsdf_; }

 private:
  struct Ray;
  struct Incidence;
  struct Light;
  struct Lobe;
  struct Way;
  Incidence incidence(const core::StokesVector& light) const;
  Lobe lobe(const SampledBsdf::Response& response, ScatterKind kind) const;
  Way way(const Ray& in, const Ray& out, const core::Vec3& k_out) const;
  Light outgoing(const Incidence& in, const SampledBsdf::Response& response, ScatterKind kind, const Ray& out) const;

  SampledBsdf bsdf_;
  core::Vec2 axis_;
};

}  // namespace evenglow::tracer
