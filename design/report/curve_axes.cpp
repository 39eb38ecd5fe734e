#include <algorithm>
#include <cmath>
#include <limits>

#include "design/report/curve_plot.h"

namespace evenglow::design {
namespace {

/// Grows with each finite value.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool empty() const { return low > high; }
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

double error_of(const Curve& curve, std::size_t i) {
  const double se = i < curve.se.size() ? curve.se[i] : 0.0;
  return std::isfinite(se) ? se : 0.0;
}

Axis log_y_axis(const CurvePlot& plot) {
  Extent extent;
  for (const Curve& curve : plot.curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      const double upper = curve.y[i] + error_of(curve, i);
      // A value that noise made negative still shows how high its bar reaches.
      if (curve.y[i] > 0.0) extent.include(curve.y[i]);
      if (upper > 0.0) extent.include(upper);
    }
  }
  if (extent.empty()) return log_axis({0.1, 1.0});
  return log_axis({extent.low * 0.95, extent.high});
}

}  // namespace

Axis x_axis_of(const CurvePlot& plot, int wanted_ticks) {
  Extent extent;
  for (const Curve& curve : plot.curves) {
    for (const double x : curve.x) extent.include(x);
    if (curve.stepped && curve.x.size() > 1) {
      extent.include(1.5 * curve.x.front() - 0.5 * curve.x[1]);
      extent.include(1.5 * curve.x.back() - 0.5 * curve.x[curve.x.size() - 2]);
    }
  }
  if (extent.empty()) extent = {0.0, 1.0};
  if (plot.integer_x) return integer_axis(static_cast<int>(extent.low), static_cast<int>(extent.high), wanted_ticks);
  if (extent.low == extent.high) extent = {extent.low - 0.5, extent.high + 0.5};
  return linear_axis({extent.low, extent.high}, wanted_ticks);
}

Axis y_axis_of(const CurvePlot& plot) {
  if (plot.log_y) return log_y_axis(plot);
  Extent extent;
  bool positive = true;
  for (const Curve& curve : plot.curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      positive = positive && !(curve.y[i] < 0.0);
      extent.include(curve.y[i] - error_of(curve, i));
      extent.include(curve.y[i] + error_of(curve, i));
    }
  }
  if (extent.empty()) return rounded_axis({0.0, 1.0});
  if (plot.from_zero) {
    extent.include(0.0);
    if (positive) extent.low = 0.0;  // an error bar alone asks for no room below zero
  }
  if (extent.low == 0.0 && extent.high == 0.0) extent.high = 1.0;
  const double least = 0.005 * std::max(std::abs(extent.low), std::abs(extent.high));
  if (extent.high - extent.low < least) extent = {extent.low - least, extent.high + least};
  return rounded_axis({extent.low, extent.high});
}

}  // namespace evenglow::design
