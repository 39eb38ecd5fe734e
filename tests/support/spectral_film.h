#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/units.h"

namespace evenglow::tests {

/// A film whose scatter does not depend on direction and follows a known law of wavelength:
///
///     ln S linear in lambda,     D / S (cos 2 delta, sin 2 delta) = (x, y) linear in lambda,
///
/// the rule that tables interpolate by, so that a table with two nodes of lambda must give it everywhere between them.
struct SpectralFilm {
  static double log_S(double nm) { return std::log(0.05) + 0.004 * (nm - 450.0); }
  static double x(double nm) { return -0.6 + 0.004 * (nm - 450.0); }
  static double y(double nm) { return 0.3 - 0.001 * (nm - 450.0); }
  /// S is the same in all directions: the integral over the hemisphere is pi.
  static double total(double nm, double q1, double q2) {
    return 0.5 * core::kPi * std::exp(log_S(nm)) * (1.0 - x(nm) * q1 - y(nm) * q2);
  }

  /// Reflection alone.
  static std::string csv(const std::vector<double>& wavelengths) {
    std::string text =
        "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";
    for (const int theta : {0, 90}) {
      for (const double nm : wavelengths) {
        const double S = std::exp(log_S(nm)), D = S * std::hypot(x(nm), y(nm));
        text += fmt::format("BRDF,0,0,0,{},{},{},{},{}\n", theta, nm, 0.5 * (S - D), 0.5 * (S + D),
                            0.5 * std::atan2(y(nm), x(nm)) / core::kRadPerDeg);
      }
    }
    return text;
  }
};

}  // namespace evenglow::tests
