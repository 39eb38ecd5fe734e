#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/vec3.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/sources/intensity_table.h"
#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// Into which directions a source emits: I(theta, phi) about the normal into the backlight. Samples have the density
/// I(theta, phi) / flux per solid angle, so that every photon weighs the same. Azimuths count as in type C photometry
/// (IES LM-63; C planes of EULUMDAT): seen from behind the source, looking into the backlight, with +z up (+y for a
/// source at the bottom or top), 0 is to the right and 90 degrees is up.
class EmissionPattern {
 public:
  /// I ~ cos^n theta; 1 is Lambertian.
  static EmissionPattern cosine_power(double n);
  /// The front hemisphere of a table; what the table holds beyond 90 degrees is left out. `turn` (rad) adds to the
  /// azimuths. `absolute`: the table is in cd, so that its flux counts. Throws `core::Error` for a table without light
  /// within 90 degrees.
  static EmissionPattern tabulated(const IntensityTable& table, double turn, bool absolute);

  core::Vec3 sample(core::PhotonRng& rng, const SideAxes& axes) const;

  /// Flux of the front hemisphere in lm; none if only the shape is known.
  std::optional<double> flux() const { return flux_; }
  /// Share of the table's flux beyond 90 degrees, which is not emitted.
  double left_out() const { return left_out_; }

 private:
  core::Vec3 sample_table(core::PhotonRng& rng, const SideAxes& axes) const;

  double exponent_ = 1.0;
  double turn_ = 0.0;               ///< rad
  IntensityTable table_;            ///< front hemisphere; without nodes: cos^n
  std::vector<double> cumulative_;  ///< flux up to and with each cell, phi by phi
  std::optional<double> flux_;
  double left_out_ = 0.0;
};

}  // namespace evenglow::tracer
