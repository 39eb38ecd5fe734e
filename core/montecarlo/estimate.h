#pragma once

#include <cmath>

namespace evenglow::core {

/// A Monte Carlo result: never without its standard error.
struct Estimate {
  double value = 0.0;
  double se = 0.0;  ///< standard error of the value, same unit
};

/// a / b of independent estimates, errors to first order.
inline Estimate ratio(const Estimate& a, const Estimate& b) {
  const double value = a.value / b.value;
  return {value, std::abs(value) * std::hypot(a.se / a.value, b.se / b.value)};
}

}  // namespace evenglow::core
