#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/lobe_parameters.h"

namespace evenglow::tracer {

/// Axis of the film that light is polarized along.
enum class FilmLight { pass = 0, block = 1 };

/// Integral of exp(-(x^2/sx^2 + y^2/sy^2) / 2) over the unit disk: what a lobe of amplitude 1 sends into the hemisphere
/// at normal incidence. In polar coordinates the radius is done in closed form and the angle by the trapezoidal rule,
/// which converges exponentially for a periodic function.
double lobe_integral(double sx, double sy);

/// Semi-empirical polarized BSDF of a scattering reflective polarizer (configs/data/README.md, "The model"). X =
/// reflection or transmission, s = pass or block light, d = beta_out - beta_in with beta the tangential direction
/// cosines in the film's axes, g(q) = exp(-q/2):
///
///     H_R,p = [p1 g(dx^2/sx^2 + dy^2/sy^2)                    + p3 g(d^2/s3p^2)] / e0
///     H_R,b = [b1 g(dx^2/sx^2 + dy^2/sy^2) + b2 g(d^2/s2^2)   + b3 g(d^2/s3b^2)] / e0
///     H_T,s = [a1 g(d^2/t1^2) + a2 g(d^2/t2^2) + a3 g(d^2/t3^2)] / e0              (a1 = 0 for s = b)
///     f_X,s(in, out) = c_X,s(in) c_X,s(out) H_X,s(d)                               (the wide lobe of H_R,p keeps c =
///     1)
///
/// so that f(in, out) = f(out, in). c makes the integral of f cos over the hemisphere equal to
///
///     rho_T,s(sigma) = T_s (1 - F(sigma)) / (1 - F(0)),     rho_R,s = 1 - absorption - rho_T,s
///
/// with T_s the integral of H_T,s at normal incidence and F the reflectance of natural light of two smooth faces
/// (2 R / (1 + R) for s and for p light, averaged). What happens at oblique incidence is an assumption: the
/// measurements that the default parameters come from hold none.
class LobeModel {
 public:
  /// Throws `core::Error` that says why if the parameters would make energy: T above 1 - absorption, or a wide lobe of
  /// reflected pass light that alone sends back more than R.
  explicit LobeModel(const LobeParameters& parameters);

  const LobeParameters& parameters() const { return parameters_; }

  /// Tangential direction cosines in the film's axes (x along the pass axis).
  struct Beta {
    double x = 0.0, y = 0.0;
  };

  /// f (1/sr): luminance over the illuminance by light polarized along one axis. Inside the unit circle.
  double bsdf(ScatterKind kind, FilmLight light, const Beta& in, const Beta& out) const;
  /// c. Inside the unit circle.
  double scaling(ScatterKind kind, FilmLight light, const Beta& beta) const;
  /// rho at the angle of incidence `sigma` (rad).
  double hemispherical(ScatterKind kind, FilmLight light, double sigma) const;
  /// H integrated at normal incidence, before it is scaled: T_s and R_s of the luminances.
  double unscaled(ScatterKind kind, FilmLight light) const;

  /// f of both lights in the angles of a `BsdfTable` (rad). Directions at or below the horizon: 0.
  struct Value {
    double pass = 0.0, block = 0.0;  ///< 1/sr
  };
  Value at(ScatterKind kind, double psi, double sigma, double phi, double theta) const;

 private:
  /// One Gaussian of H.
  struct Lobe {
    double amplitude = 0.0;  ///< 1/sr
    double sx = 1.0, sy = 1.0;
    double at(double dx, double dy) const;
  };
  struct Part {
    std::vector<Lobe> scaled;  ///< with c
    std::vector<Lobe> fixed;   ///< without
    std::vector<double> c;     ///< quadrant of the grid, index ix * kNodes + iy
  };
  static constexpr std::size_t kSteps = 40;  ///< of the grid, from 0 to 1
  static constexpr std::size_t kNodes = kSteps + 1;

  const Part& part(ScatterKind kind, FilmLight light) const {
    return parts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(light)];
  }
  void describe();
  void check() const;
  void solve(ScatterKind kind, FilmLight light);

  LobeParameters parameters_;
  std::array<std::array<Part, 2>, 2> parts_;  ///< by kind, then light
};

}  // namespace evenglow::tracer
