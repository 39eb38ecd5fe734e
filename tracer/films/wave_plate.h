#pragma once

#include "tracer/films/film_axis.h"
#include "tracer/films/specular_film.h"

namespace evenglow::tracer {

/// A uniaxial sheet with its optic axis in the plane of the film (a-plate) at one wavelength.
///
/// Of an oblique ray, with s = sin sigma in air and psi_c the angle of the optic axis c from its tangential direction,
/// the two waves run in the sheet with the normal components (in units of 2 pi / lambda)
///
///     k_o^2 = n_o^2 - s^2,     k_e^2 = n_e^2 - s^2 (sin^2 psi_c + (n_e / n_o)^2 cos^2 psi_c)
///
/// (from (k . c)^2 / n_o^2 + (k^2 - (k . c)^2) / n_e^2 = 1; Lekner, J. Phys.: Condens. Matter 3, 6121, 1991; Yeh & Gu,
/// sect. 3.1), so that the retardance is that at normal incidence times (k_e - k_o) / (n_e - n_o). For small n_e - n_o
/// this is (1 - sin^2 sigma' cos^2 psi_c) / cos sigma'. The ordinary wave is polarized across c as the ray sees it
/// (pass_axis.h, index n_o).
///
/// A spread: the retardance of the light is normally distributed with the standard deviation `spread` (thickness,
/// wavelengths), which multiplies cos and sin of the retardance by exp(-spread^2 / 2): the mean of Mueller matrices is
/// one, so it stays physical. Each passage counts with its own mean.
class WavePlate final : public SpecularFilm {
 public:
  struct Spec {
    double retardance = 0.0;       ///< rad at normal incidence, >= 0: slow axis behind fast axis
    double spread = 0.0;           ///< rad at normal incidence, >= 0
    double fast_axis = 0.0;        ///< rad, from +x towards +y
    double index = 1.59;           ///< n_o, > 1
    double birefringence = 0.003;  ///< n_e - n_o, above 0: the optic axis is the slow axis; below: the fast one
    bool faces = false;            ///< smooth faces of index n_o (`faced_body`); else none: coated, or laminated
  };
  /// Throws `core::Error` for what is out of its range; n_e must be above 1.
  explicit WavePlate(const Spec& spec);

  /// Retardance of this ray over that at normal incidence.
  double retardance_factor(const TangentialFrame& frame) const;

 private:
  Specular matrices(const TangentialFrame& frame) const override;
  AxisAngle fast_axis_of(const TangentialFrame& frame) const;

  Spec spec_;
  FilmAxis fast_, slow_;
};

}  // namespace evenglow::tracer
