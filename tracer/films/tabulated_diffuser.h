#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracer/films/dbef.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A diffuser from a BSDF table of natural light (scatter_table.h): power and directions from the table, whatever the
/// polarization; the polarization of what is scattered as of `Diffuser`. The same from both sides and in every azimuth;
/// all light that leaves it is scattered.
class TabulatedDiffuser final : public Bsdf {
 public:
  struct Totals {
    double transmittance = 0.0, reflectance = 0.0;  ///< in [0, 1], sum at most 1
  };
  /// `totals`: the table is normalized to them at every incidence; without, its own integrals count, scaled down where
  /// they create energy (`remarks`). `depolarization` in [0, 1].
  TabulatedDiffuser(const BsdfTable& table, const std::optional<Totals>& totals, double depolarization);

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override;
  core::StokesVector evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const override;
  bool scatters() const override { return true; }
  Specular specular(const core::Vec3&) const override { return {}; }

  /// Share of light at this incidence (unit direction) that is reflected (transmitted).
  double hemispherical(const core::Vec3& k, ScatterKind kind) const;
  /// How the table was changed to make it usable, one sentence each.
  std::vector<std::string> remarks() const;

 private:
  TabulatedDbef lobes_;
  double depolarization_;
};

}  // namespace evenglow::tracer
