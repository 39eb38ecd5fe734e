#pragma once

#include <cstddef>
#include <vector>

#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {

/// The ABg lobe of stray-light work in direction cosines (Pfisterer, "Approximated scatter models for stray light
/// analysis", Optics & Photonics News 22, 2011), made reciprocal and energy-keeping:
///
///     f(in, out) = c(|b_in|) c(|b_out|) h(|b_out - b_in|),   h(d) = A / (B + d^g) for d < 2,   b tangential part.
///
/// A follows from the integral of h over the disk of radius 2 (all that a sheet can scatter by), which is 1. c is the
/// fixed point of c(b) = 1 / integral of c(b') h over the unit disk, as of `SymmetricLobe`; so the integral of
/// f cos(theta) over the hemisphere is 1 for every incidence (to 2e-4) and
/// f(in, out) = f(out, in).
class AbgLobe {
 public:
  static constexpr double kLeastWidth = 1e-3;  ///< of B^(1/g), where h has fallen to one half
  static constexpr double kLargestWidth = 2.0;

  /// `b`: B > 0; `g` in [0.5, 6]; B^(1/g) in [kLeastWidth, kLargestWidth]. `core::Error` otherwise.
  AbgLobe(double b, double g);

  /// c at |b| in [0, 1].
  double scaling(double beta) const;
  double largest_scaling() const { return largest_; }
  /// f in 1/sr.
  double value(double beta_in, double beta_out, double distance2) const;
  /// A distance d in (0, 2) with density 2 pi d h(d).
  double draw_way(core::PhotonRng& rng) const;

 private:
  double shape(double way) const;
  void add_circle(double beta, double way, double ring, double* row) const;
  std::vector<double> kernel() const;
  void solve();

  double b_, g_, width_;
  double a_ = 1.0;
  double core_ = 0.0;  ///< share of the proposals with d below the width
  double scale_ = 1.0, inverse_log_ = 1.0;
  double largest_ = 1.0;
  std::vector<double> scaling_;  ///< at nodes even in ln(1 + (1 - beta) / scale)
};

}  // namespace evenglow::tracer
