#pragma once

#include <complex>

#include "tracer/films/film_axis.h"
#include "tracer/films/specular_film.h"

namespace evenglow::tracer {

/// Reflective polarizer of fine metal wires: given by what it does at normal incidence, its angle dependence by
/// two-sided impedance boundary conditions (Leontovich; for gratings of period well below the wavelength: Tretyakov,
/// Analytical Modeling in Applied Electromagnetics, 2003, ch. 4; Braver et al., arXiv:2502.04336).
///
/// The film is the same from both sides, so light that falls on it evenly from both (even), or evenly with the sign
/// changed (odd), sees a wall with the tangential reflection g = r + t, or r - t. A wall is a surface admittance Y = (1
/// - G)(1 + G)^-1 (in units of that of free space), a matrix with the axes of the film, and local: it does not know the
/// angle. A wave of angle sigma has the admittance Y0 = diag(1 / cos sigma, cos sigma) in its tangential frame, so
///
///     G(sigma) = (Y0 + Y)^-1 (Y0 - Y),     r = (G_even + G_odd) / 2,  t = (G_even - G_odd) / 2.
///
/// Re Y >= 0, so each wall returns at most what it gets, and T + R <= 1 for every angle and polarization. Of the powers
/// at normal incidence only the phases are open; they are those of a thin grid, which shorts the odd field, g_odd =
/// -sqrt(T + R), with r and t a quarter period apart (which no T + R <= 1 forbids and a lossless film demands):
/// capacitive across the wires, inductive along them, r = +i t sqrt(R / T) and -i t sqrt(R / T). So a lossless film is
/// exactly the thin grid of these boundary conditions: in its principal planes T(sigma) = T / (T + R cos^2 sigma) for p
/// and T / (T + R / cos^2 sigma) for s light. For T = 1, R = 0 and T = 0, R = 1 it is the unidirectionally conducting
/// screen: `IdealPolarizer` with the index 1.
class WireGrid final : public SpecularFilm {
 public:
  struct Powers {
    double transmittance_pass = 0.88, reflectance_pass = 0.04;      ///< field across the wires
    double transmittance_block = 0.00088, reflectance_block = 0.9;  ///< field along the wires
  };
  /// `axis`: rad, pass axis (across the wires) from +x towards +y. T, R in [0, 1], T + R <= 1 (`core::Error`).
  WireGrid(const Powers& powers, double axis);

 private:
  /// Tangential reflection of the even and the odd wall at normal incidence.
  struct Walls {
    std::complex<double> even, odd;
  };
  /// `sign`: +1 capacitive, -1 inductive.
  static Walls walls(double transmittance, double reflectance, double sign);
  Specular matrices(const TangentialFrame& frame) const override;

  Walls pass_, block_;
  FilmAxis axis_;
};

}  // namespace evenglow::tracer
