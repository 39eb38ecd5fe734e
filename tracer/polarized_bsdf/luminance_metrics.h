#pragma once

#include <span>

namespace evenglow::tracer {

/// One pair to be compared.
struct LuminancePair {
  double theta = 0.0;      ///< rad, from the specular (direct) axis
  double measured = 0.0;   ///< m, cd/m2; pairs with m = 0 count in `l2` alone
  double simulated = 0.0;  ///< s, cd/m2
};

/// How far simulated luminances are from measured ones; all fractions, NaN where no pair counts.
struct LuminanceMetrics {
  double plain = 0.0;      ///< RMS of (s - m) / m
  double at_ten = 0.0;     ///< the same at theta = 10 degrees
  double to_twenty = 0.0;  ///< the same at theta <= 20 degrees
  double weighted = 0.0;   ///< sqrt(sum m ((s - m) / m)^2 / sum m)
  double l2 = 0.0;         ///< sqrt(sum (s - m)^2 / sum m^2)
  int pairs = 0;
};
LuminanceMetrics luminance_metrics(std::span<const LuminancePair> pairs);

}  // namespace evenglow::tracer
