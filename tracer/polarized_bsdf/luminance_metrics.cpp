#include "tracer/polarized_bsdf/luminance_metrics.h"

#include <cmath>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kRounding = 1e-9;  // rad

/// Weighted mean square.
struct MeanSquare {
  double sum = 0.0, weight = 0.0;
  void add(double value, double w = 1.0) {
    sum += w * value * value;
    weight += w;
  }
  double root() const { return std::sqrt(sum / weight); }
};

}  // namespace

LuminanceMetrics luminance_metrics(std::span<const LuminancePair> pairs) {
  MeanSquare plain, at_ten, to_twenty, weighted, difference, measured;
  for (const LuminancePair& pair : pairs) {
    const double m = pair.measured, d = pair.simulated - m;
    difference.add(d);
    measured.add(m);
    if (m <= 0.0) continue;
    plain.add(d / m);
    weighted.add(d / m, m);
    const double theta = pair.theta / core::kRadPerDeg;
    if (std::abs(theta - 10.0) < kRounding / core::kRadPerDeg) at_ten.add(d / m);
    if (theta < 20.0 + kRounding / core::kRadPerDeg) to_twenty.add(d / m);
  }
  LuminanceMetrics metrics;
  metrics.plain = plain.root();
  metrics.at_ten = at_ten.root();
  metrics.to_twenty = to_twenty.root();
  metrics.weighted = weighted.root();
  metrics.l2 = std::sqrt(difference.sum / measured.sum);
  metrics.pairs = static_cast<int>(pairs.size());
  return metrics;
}

}  // namespace evenglow::tracer
