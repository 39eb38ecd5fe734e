#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace evenglow::tracer {

/// Cubic spline on a circle, twice continuously differentiable (de Boor, A Practical Guide to Splines, ch. IV, periodic
/// end conditions). Nodes need not be equally spaced; one node gives a constant.
class PeriodicSpline {
 public:
  /// `nodes` ascending, within one `period`; at least one.
  PeriodicSpline(std::vector<double> nodes, double period);

  std::size_t size() const { return nodes_.size(); }

  /// Where a point lies: value = a y[i] + b y[j] + c m[i] + d m[j] with y the values and m the second derivatives at
  /// the nodes; a and b alone are linear interpolation.
  struct Place {
    std::size_t i = 0, j = 0;
    double a = 1.0, b = 0.0, c = 0.0, d = 0.0;
  };
  /// `x` any real number.
  Place place(double x) const;

  /// Second derivatives at the nodes of the spline through `values` (size()).
  std::vector<double> second_derivatives(std::span<const double> values) const;

  /// Weights w with spline(x) = sum w[k] values[k], and those of linear interpolation.
  std::vector<double> weights(double x) const;
  std::vector<double> linear_weights(double x) const;

 private:
  double gap(std::size_t i) const;  ///< from node i to the next one, around the circle

  std::vector<double> nodes_;
  double period_;
  std::vector<double> curvature_;  ///< size() x size(), row-major: values to second derivatives
};

}  // namespace evenglow::tracer
