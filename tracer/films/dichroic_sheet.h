#pragma once

#include <optional>

#include "tracer/films/film_axis.h"
#include "tracer/films/specular_film.h"

namespace evenglow::tracer {

/// Absorbing polarizer as a sheet of uniaxial dye: its transmittances change with the angle of incidence.
///
/// The dye absorbs along the block axis b (alpha_b) and, a little, across it (alpha_p). Of an oblique ray with the
/// inner angle sigma', sin sigma' = sin sigma / n, the ordinary wave (polarized across b as the ray sees it,
/// pass_axis.h) is absorbed with alpha_p, the extraordinary one with alpha_p cos^2 g + alpha_b sin^2 g, g the angle
/// between ray and b, cos g = sin sigma' (b . h); both on the path d / cos sigma'. This is the imaginary part of the
/// index of a weakly absorbing uniaxial medium, 1 / n_e(g)^2 = cos^2 g / n_o^2 + sin^2 g / n_e^2, to first order (Yeh &
/// Gu, Optics of Liquid Crystal Displays, 2nd ed., sect. 2.5; Born & Wolf, 15.6). With a = exp(-alpha d):
///
///     a_pass(sigma) = a_p^(1 / cos sigma'),   a_block(sigma) = a_p^(cos^2 g / cos sigma') a_b^(sin^2 g / cos sigma')
///
/// The birefringence of the dye and the sheet is left out: one of the two waves is all but gone.
class DichroicSheet final : public SpecularFilm {
 public:
  struct Spec {
    double k1 = 0.8596;  ///< transmittance at normal incidence of light along the pass axis, faces included
    double k2 = 0.0004;  ///< along the block axis, at most k1
    double axis = 0.0;   ///< rad, pass axis from +x towards +y
    double index = 1.5;  ///< refractive index of the sheet, > 1
    /// Reflectance of any light at any angle, state kept; k1 + reflectance <= 1. None: both faces are smooth
    /// (Fresnel, `faced_body`) and k1 <= greatest_through_faces(index).
    std::optional<double> reflectance = 0.04;
  };
  /// Throws `core::Error` for what is out of its range.
  explicit DichroicSheet(const Spec& spec);

 private:
  Specular matrices(const TangentialFrame& frame) const override;

  Spec spec_;
  FilmAxis axis_;
  double pass_, block_;  ///< a_p and a_b: the body alone, one passage at normal incidence
};

}  // namespace evenglow::tracer
