#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/units.h"

namespace evenglow::tracer {

/// Interval of an axis and share in it, both ends held.
struct Bracket {
  std::size_t i = 0, j = 0;
  double t = 0.0;  ///< of node j
};

/// Where `x` lies among `nodes` (ascending, at least one); linear in `coordinate` of the axis.
template <typename Coordinate>
Bracket bracket(const std::vector<double>& nodes, double x, Coordinate&& coordinate) {
  if (nodes.size() == 1 || x <= nodes.front()) return {};
  if (x >= nodes.back()) return {nodes.size() - 1, nodes.size() - 1, 0.0};
  const auto next = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x) - nodes.begin());
  const double low = coordinate(nodes[next - 1]);
  return {next - 1, next, (coordinate(x) - low) / (coordinate(nodes[next]) - low)};
}

/// Film tables: sigma linear in sin^2 sigma (configs/data/README.md).
inline Bracket sigma_bracket(const std::vector<double>& nodes, double sigma) {
  return bracket(nodes, sigma, [](double x) { return std::sin(x) * std::sin(x); });
}

inline Bracket lambda_bracket(const std::vector<double>& nodes, double lambda_nm) {
  return bracket(nodes, lambda_nm, [](double x) { return x; });
}

/// Film tables: up to 10 degrees a function of theta^2 (a smooth peak), above of theta.
inline Bracket theta_bracket(const std::vector<double>& nodes, double theta) {
  constexpr double kPeak = 10.0 * core::kRadPerDeg + 1e-9;  // the margin is rounding of the degrees
  Bracket t = bracket(nodes, theta, [](double x) { return x; });
  if (t.j > t.i && nodes[t.j] <= kPeak) {
    t.t = (theta * theta - nodes[t.i] * nodes[t.i]) / (nodes[t.j] * nodes[t.j] - nodes[t.i] * nodes[t.i]);
  }
  return t;
}

}  // namespace evenglow::tracer
