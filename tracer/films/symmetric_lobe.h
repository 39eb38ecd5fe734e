#pragma once

#include <cstddef>
#include <vector>

namespace evenglow::tracer {

/// A Gaussian scattering lobe in direction cosines that is reciprocal and loses nothing at the horizon:
///
///     f(in, out) = c(|b_in|) c(|b_out|) g(|b_out - b_in|),   g(d) = exp(-d^2 / 2 s^2) / (2 pi s^2),   b tangential
///     part,
///
/// with c the fixed point of c(b) = 1 / integral of c(b') g over the unit disk, found by c <- c sqrt(1 / (c K c)); so
/// the integral of f cos(theta) over the hemisphere is 1 for every incidence (to 1e-6) and f(in, out) = f(out, in).
class SymmetricLobe {
 public:
  /// `width`: s, in [0.003, 2].
  explicit SymmetricLobe(double width);

  double width() const { return width_; }
  /// c at |b| in [0, 1]: cubic interpolation on an even grid.
  double scaling(double beta) const;
  double largest_scaling() const { return largest_; }
  /// f in 1/sr.
  double value(double beta_in, double beta_out, double distance2) const;

 private:
  double width_;
  double inverse_step_ = 1.0;
  double largest_ = 1.0;
  std::vector<double> scaling_;  ///< on beta = 0, step, ..., 1
};

/// exp(-x) I_0(x) for x >= 0, relative error below 6e-7 (Abramowitz & Stegun 9.8.1 and 9.8.2).
double scaled_bessel_i0(double x);

}  // namespace evenglow::tracer
