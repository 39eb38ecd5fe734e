#pragma once

#include "tracer/films/film_axis.h"
#include "tracer/films/specular_film.h"

namespace evenglow::tracer {

/// Specular polarizing film given by what it transmits and reflects of light along its pass and its block axis, the
/// same for every incidence. The axes that an oblique ray sees are those of pass_axis.h. The film is the same from both
/// sides.
class IdealPolarizer final : public SpecularFilm {
 public:
  struct Powers {
    double transmittance_pass = 1.0, reflectance_pass = 0.0;
    double transmittance_block = 0.0, reflectance_block = 1.0;
    bool keeps_reflected_state = false;  ///< reflection is that of a plain surface (identity in the tangential count,
                                         ///< with the mean of the two reflectances), not of the polarizing layer
  };

  /// `axis`: rad, pass axis from +x towards +y; `index`: refractive index that pass_axis.h counts with. Each of pass
  /// and block: T, R in [0, 1], T + R <= 1 (`core::Error` otherwise).
  IdealPolarizer(const Powers& powers, double axis, double index);

 private:
  Specular matrices(const TangentialFrame& frame) const override;

  Powers powers_;
  FilmAxis axis_;
  double index_;
};

}  // namespace evenglow::tracer
