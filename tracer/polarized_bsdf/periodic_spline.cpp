#include "tracer/polarized_bsdf/periodic_spline.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/error.h"

namespace evenglow::tracer {

PeriodicSpline::PeriodicSpline(std::vector<double> nodes, double period) : nodes_(std::move(nodes)), period_(period) {
  core::expects(!nodes_.empty() && nodes_.back() - nodes_.front() < period_, "spline nodes lie within one period");
  const std::size_t n = nodes_.size();
  curvature_.assign(n * n, 0.0);
  if (n == 1) return;
  // h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (slope[i] - slope[i-1]), indices modulo n.
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  Eigen::MatrixXd right = left;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto before = static_cast<Eigen::Index>((i + n - 1) % n);
    const auto after = static_cast<Eigen::Index>((i + 1) % n);
    const double h0 = gap((i + n - 1) % n);
    const double h1 = gap(i);
    left(row, before) += h0;
    left(row, row) += 2.0 * (h0 + h1);
    left(row, after) += h1;
    right(row, before) += 6.0 / h0;
    right(row, row) -= 6.0 / h0 + 6.0 / h1;
    right(row, after) += 6.0 / h1;
  }
  const Eigen::MatrixXd curvature = left.partialPivLu().solve(right);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      curvature_[i * n + k] = curvature(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  }
}

double PeriodicSpline::gap(std::size_t i) const {
  return i + 1 < nodes_.size() ? nodes_[i + 1] - nodes_[i] : nodes_.front() + period_ - nodes_.back();
}

PeriodicSpline::Place PeriodicSpline::place(double x) const {
  if (nodes_.size() == 1) return {};
  double offset = std::fmod(x - nodes_.front(), period_);
  if (offset < 0.0) offset += period_;
  const double wrapped = nodes_.front() + offset;
  const auto next = std::upper_bound(nodes_.begin() + 1, nodes_.end(), wrapped);
  Place p;
  p.i = static_cast<std::size_t>(next - nodes_.begin()) - 1;
  p.j = next == nodes_.end() ? 0 : p.i + 1;
  const double h = gap(p.i);
  p.b = std::clamp((wrapped - nodes_[p.i]) / h, 0.0, 1.0);
  p.a = 1.0 - p.b;
  p.c = (p.a * p.a * p.a - p.a) * h * h / 6.0;
  p.d = (p.b * p.b * p.b - p.b) * h * h / 6.0;
  return p;
}

std::vector<double> PeriodicSpline::second_derivatives(std::span<const double> values) const {
  const std::size_t n = nodes_.size();
  std::vector<double> m(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) m[i] += curvature_[i * n + k] * values[k];
  }
  return m;
}

std::vector<double> PeriodicSpline::linear_weights(double x) const {
  const Place p = place(x);
  std::vector<double> w(nodes_.size(), 0.0);
  w[p.i] += p.a;
  w[p.j] += p.b;
  return w;
}

std::vector<double> PeriodicSpline::weights(double x) const {
  const Place p = place(x);
  const std::size_t n = nodes_.size();
  std::vector<double> w = linear_weights(x);
  for (std::size_t k = 0; k < n; ++k) w[k] += p.c * curvature_[p.i * n + k] + p.d * curvature_[p.j * n + k];
  return w;
}

}  // namespace evenglow::tracer
