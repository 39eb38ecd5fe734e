#pragma once

#include <string>
#include <vector>

#include "tracer/films/film_axis.h"
#include "tracer/optics/bsdf.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/sampled_mueller.h"

namespace evenglow::tracer {

/// Scattering film from a table of Mueller matrices (docs/films.md):
///
///     M = R(-psi_o) M_table R(psi_i)
///
/// with psi_i, psi_o the angles of the film axis from the tangential directions of the incident and the outgoing ray,
/// all in the tangential count. Whatever the film does to polarization is kept: retardance and depolarization too.
///
/// The film is taken to be the same from both sides (light from below sees the mirror image) and after half a turn.
class TabulatedMueller final : public Bsdf {
 public:
  /// `axis`: rad, from +x towards +y. Without `hemispherical` the table's own integrals count (see `SampledMueller`).
  TabulatedMueller(const MuellerTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                   double axis);

  /// The outgoing light is `evaluate` towards its direction, rescaled to the incident power.
  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return true; }
  Specular specular(const core::Vec3&) const override { return {}; }

  /// Share of the incident power that is reflected (transmitted) into the hemisphere.
  double hemispherical(const core::StokesVector& incident, ScatterKind kind) const;

  /// How the table was changed to make it usable, one sentence each.
  const std::vector<std::string>& remarks() const { return bsdf_.remarks(); }
  const SampledMueller& tables() const { return bsdf_; }

 private:
  struct Incidence;
  Incidence incidence(const core::StokesVector& incident) const;

  SampledMueller bsdf_;
  FilmAxis axis_;
};

}  // namespace evenglow::tracer
