#include "design/dots/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/montecarlo/batches.h"

namespace evenglow::design {
namespace {

/// F(x, y) = x y (1 + a (x - 1) / 2 + b (y - 1) / 2), the integral of 1 + a (u - 1/2) + b (v - 1/2).
struct LinearShare {
  double a, b;

  double at(double x, double y) const { return x * y * (1.0 + 0.5 * a * (x - 1.0) + 0.5 * b * (y - 1.0)); }
  /// Integral of F over [x, 1] x [y, 1].
  double beyond(double x, double y) const {
    const double x1 = (1.0 - x * x) / 2.0, x2 = (1.0 - x * x * x) / 3.0;
    const double y1 = (1.0 - y * y) / 2.0, y2 = (1.0 - y * y * y) / 3.0;
    return (1.0 - 0.5 * (a + b)) * x1 * y1 + 0.5 * a * x2 * y1 + 0.5 * b * x1 * y2;
  }
  /// Integral of F^2 over the unit square, a polynomial of degree 4 in x and in y: 3 points of Gauss are exact.
  double squared() const {
    const double step = 0.5 * std::sqrt(0.6);
    const std::array<double, 3> at3 = {0.5 - step, 0.5, 0.5 + step}, weight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sum += weight[i] * weight[j] * std::pow(at(at3[i], at3[j]), 2);
    }
    return sum;
  }
};

}  // namespace

double squared_discrepancy(const SampleWindow& window) {
  const LinearShare share{window.slope_x, window.slope_y};
  const std::size_t n = window.x.size();
  double single = 0.0, pairs = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = window.x[i], y = window.y[i];
    single += share.beyond(x, y);
    pairs += (1.0 - x) * (1.0 - y);
    double row = 0.0;
    for (std::size_t j = 0; j < i; ++j) row += (1.0 - std::max(x, window.x[j])) * (1.0 - std::max(y, window.y[j]));
    pairs += 2.0 * row;
  }
  const auto count = static_cast<double>(n);
  return share.squared() - 2.0 * single / count + pairs / (count * count);
}

double accepted_discrepancy(double count) {
  return 0.13 * std::pow(count, -1.15);
}

double random_discrepancy(double count) {
  return (1.0 / 4.0 - 1.0 / 9.0) / count;
}

DiscrepancyStatistics discrepancy_statistics(const std::vector<SampleWindow>& windows, int threads) {
  DiscrepancyStatistics result;
  std::vector<double> ratios(windows.size());
  core::run_batches(windows.size(), threads, [&](std::size_t i) {
    ratios[i] = squared_discrepancy(windows[i]) / accepted_discrepancy(static_cast<double>(windows[i].x.size()));
  });
  result.windows = windows.size();
  if (windows.empty()) return result;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    result.accepted += ratios[i] <= 1.0;
    result.mean_count += static_cast<double>(windows[i].x.size()) / static_cast<double>(windows.size());
    result.mean_ratio += ratios[i] / static_cast<double>(windows.size());
    result.worst_ratio = std::max(result.worst_ratio, ratios[i]);
  }
  return result;
}

}  // namespace evenglow::design
