#pragma once

#include <array>
#include <cmath>
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
  /// uniform < c(|b|) / largest_scaling() for `beta2` = |b|^2 < 1? Mostly told by bounds of c, without working it out.
  bool accepts(double beta2, double uniform) const {
    const Bounds& bounds = bounds_[static_cast<std::size_t>(beta2 * static_cast<double>(kBounds))];
    const double c = uniform * largest_;
    if (c < static_cast<double>(bounds.least)) return true;
    return c < static_cast<double>(bounds.most) && c < scaling(std::sqrt(beta2));
  }
  /// f in 1/sr.
  double value(double beta_in, double beta_out, double distance2) const;

 private:
  /// Of c over an interval of |b|^2, rounded outwards.
  struct Bounds {
    float least = 0.0f, most = 0.0f;
  };
  static constexpr std::size_t kBounds = 256;  ///< intervals of |b|^2 in [0, 1]
  void find_bounds();

  double width_;
  double inverse_step_ = 1.0;
  double largest_ = 1.0;
  std::vector<double> scaling_;  ///< on beta = 0, step, ..., 1
  std::array<Bounds, kBounds> bounds_;
};

/// exp(-x) I_0(x) for x >= 0, relative error below 6e-7 (Abramowitz & Stegun 9.8.1 and 9.8.2).
double scaled_bessel_i0(double x);

}  // namespace evenglow::tracer
