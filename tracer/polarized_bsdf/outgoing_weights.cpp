#include "tracer/polarized_bsdf/outgoing_weights.h"

#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {

/// Products of two line integrals. In u, exact: the integral of 2 u^3 against the hat function of each line. In phi'
/// the same with r^2, by Simpson's rule on 64 parts of each interval (error below 1e-9 even beside the knee at
/// grazing).
std::vector<double> outgoing_weights(std::size_t u, std::size_t phi, double sigma) {
  const double step = 1.0 / static_cast<double>(u);
  std::vector<double> along_u(u + 1, 0.0);
  for (std::size_t i = 0; i < u; ++i) {
    const double a = static_cast<double>(i) * step;
    const double b = a + step;
    const double all = (std::pow(b, 4) - std::pow(a, 4)) / 2.0;
    const double first = 2.0 * (std::pow(b, 5) - std::pow(a, 5)) / 5.0;  // integral of 2 u^4
    const double upper = (first - a * all) / step;
    along_u[i] += all - upper;
    along_u[i + 1] += upper;
  }
  constexpr int kParts = 64;
  const double turn = 2.0 * core::kPi / static_cast<double>(phi);
  std::vector<double> along_phi(phi, 0.0);
  for (std::size_t k = 0; k < phi; ++k) {
    for (int i = 0; i <= kParts; ++i) {
      const double t = static_cast<double>(i) / kParts;
      const double azimuth = (static_cast<double>(k) + t) * turn;
      const double r =
          horizon_distance(std::sin(sigma), std::pow(std::cos(sigma), 2), std::cos(azimuth), std::sin(azimuth));
      const double simpson = (i == 0 || i == kParts) ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
      const double weight = simpson / (3.0 * kParts) * turn * r * r;
      along_phi[k] += weight * (1.0 - t);
      along_phi[(k + 1) % phi] += weight * t;
    }
  }
  std::vector<double> weights;
  for (const double p : along_phi) {
    for (const double w : along_u) weights.push_back(p * w);
  }
  return weights;
}

}  // namespace evenglow::tracer
