#include "design/engine/level_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

constexpr double kShapes[] = {1.0, 2.0, 4.0, std::numeric_limits<double>::infinity()};
constexpr int kScales = 60;       // of the first look
constexpr double kReach = 30.0;   // scales beyond the measured levels
constexpr int kRefinements = 40;  // of the golden section
constexpr double kRidge = 1e-3;   // of the variances: a covariance from few batches is never quite regular
constexpr int kSteps = 400;       // of the search for the greatest value

double saturation(double level, double scale, double k) {
  const double u = level / scale;
  return std::isinf(k) ? -std::expm1(-u) : -std::expm1(-k * std::log1p(u / k));
}

/// Limit and decline for a scale and k.
LevelCurve linear_fit(const LevelData& data, const Eigen::MatrixXd& weight, double scale, double k) {
  const auto n = static_cast<Eigen::Index>(data.levels.size());
  Eigen::MatrixXd basis(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double level = data.levels[static_cast<std::size_t>(i)];
    basis(i, 0) = saturation(level, scale, k);
    basis(i, 1) = -level * basis(i, 0);
  }
  const Eigen::MatrixXd weighted = basis.transpose() * weight;
  Eigen::Vector2d p = (weighted * basis).ldlt().solve(weighted * data.efficiency);
  if (!(p.allFinite() && p[0] > 0.0 && p[1] >= 0.0)) {
    p[0] = (weighted.row(0) * data.efficiency)(0) / (weighted.row(0) * basis.col(0))(0);
    p[1] = 0.0;
  }
  const Eigen::VectorXd rest = data.efficiency - basis * p;
  return {p[0], scale, k, p[1] / p[0], rest.dot(weight * rest)};
}

LevelCurve best_scale(const LevelData& data, const Eigen::MatrixXd& weight, double k) {
  const double from = std::log(data.levels.front() / kReach);
  const double to = std::log(data.levels.back() * kReach);
  const auto at = [&](double log_scale) { return linear_fit(data, weight, std::exp(log_scale), k); };
  LevelCurve best = at(from);
  for (int i = 1; i <= kScales; ++i) {
    const LevelCurve curve = at(from + (to - from) * i / kScales);
    if (curve.chi_square < best.chi_square) best = curve;
  }
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = std::log(best.scale) - (to - from) / kScales;
  double high = std::log(best.scale) + (to - from) / kScales;
  for (int i = 0; i < kRefinements; ++i) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    (at(a).chi_square < at(b).chi_square ? high : low) = at(a).chi_square < at(b).chi_square ? b : a;
  }
  const LevelCurve refined = at(0.5 * (low + high));
  return refined.chi_square < best.chi_square ? refined : best;
}

Eigen::MatrixXd weight_of(const LevelData& data) {
  Eigen::MatrixXd c = data.covariance;
  const double least = 1e-12 * data.efficiency.squaredNorm();
  for (Eigen::Index i = 0; i < c.rows(); ++i) c(i, i) = c(i, i) * (1.0 + kRidge) + least;
  return c.inverse();
}

LevelCurve fit(const LevelData& data, const Eigen::MatrixXd& weight, std::optional<double> shape) {
  if (shape) return best_scale(data, weight, *shape);
  LevelCurve best;
  best.chi_square = std::numeric_limits<double>::infinity();
  for (const double k : kShapes) {
    const LevelCurve curve = best_scale(data, weight, k);
    if (curve.chi_square < best.chi_square) best = curve;
  }
  return best;
}

double greatest(const LevelCurve& curve, double low, double high, double& where) {
  double best = -1.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double level = low * std::pow(high / low, static_cast<double>(i) / kSteps);
    if (curve.at(level) <= best) continue;
    best = curve.at(level);
    where = level;
  }
  return best;
}

}  // namespace

double LevelCurve::at(double level) const {
  return limit * saturation(level, scale, k) * (1.0 - decline * level);
}

LevelCurve fit_level_curve(const LevelData& data) {
  core::expects(data.levels.size() >= 3, "efficiencies at three levels at least");
  return fit(data, weight_of(data), std::nullopt);
}

double level_of(const LevelCurve& curve, double efficiency, double low, double high) {
  double top = high;
  if (greatest(curve, low, high, top) < efficiency) return high;
  if (curve.at(low) >= efficiency) return low;
  double below = low;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(below * top);
    (curve.at(middle) < efficiency ? below : top) = middle;
  }
  return top;
}

double knee_of(const LevelCurve& curve, double share, double low, double high) {
  double where = high;
  return level_of(curve, share * greatest(curve, low, high, where), low, high);
}

Knee find_knee(const LevelData& data, double share, double low, double high) {
  const Eigen::MatrixXd weight = weight_of(data);
  Knee knee;
  knee.curve = fit(data, weight, std::nullopt);
  knee.level = knee_of(knee.curve, share, low, high);
  Eigen::VectorXd gradient(data.efficiency.size());
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double step = std::sqrt(data.covariance(i, i));
    LevelData moved = data;
    moved.efficiency[i] += step;
    const double up = knee_of(fit(moved, weight, knee.curve.k), share, low, high);
    moved.efficiency[i] -= 2.0 * step;
    const double down = knee_of(fit(moved, weight, knee.curve.k), share, low, high);
    gradient[i] = step > 0.0 ? std::log(up / down) / (2.0 * step) : 0.0;
  }
  knee.log_se = std::sqrt(std::max(0.0, gradient.dot(data.covariance * gradient)));
  return knee;
}

}  // namespace evenglow::design
