#include "design/tolerance/sensitivity.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// The column less its mean, over its standard deviation; all zero if it does not vary.
Eigen::VectorXd standardized(Eigen::VectorXd column) {
  const double scale = column.cwiseAbs().maxCoeff();
  column.array() -= column.mean();
  const double deviation = std::sqrt(column.squaredNorm() / static_cast<double>(column.size() - 1));
  if (!(deviation > 1e-12 * scale)) return Eigen::VectorXd::Zero(column.size());
  return column / deviation;
}

}  // namespace

std::optional<Sensitivity> sensitivity(const std::vector<std::vector<double>>& parameters,
                                       const std::vector<double>& figure) {
  const auto n = static_cast<Eigen::Index>(figure.size());
  const auto all = static_cast<Eigen::Index>(n > 0 ? parameters.front().size() : 0);
  const auto fits = [&](const std::vector<double>& sample) { return static_cast<Eigen::Index>(sample.size()) == all; };
  core::expects(parameters.size() == figure.size() && std::all_of(parameters.begin(), parameters.end(), fits),
                "each sample has a figure and all parameters");
  Eigen::MatrixXd x(n, all);
  std::vector<Eigen::Index> varying;  // columns of x that are used, in front
  for (Eigen::Index p = 0; p < all; ++p) {
    Eigen::VectorXd column(n);
    for (Eigen::Index i = 0; i < n; ++i)
      column[i] = parameters[static_cast<std::size_t>(i)][static_cast<std::size_t>(p)];
    column = standardized(column);
    if (column.squaredNorm() == 0.0) continue;
    x.col(static_cast<Eigen::Index>(varying.size())) = column;
    varying.push_back(p);
  }
  const auto used = static_cast<Eigen::Index>(varying.size());
  if (used == 0 || n < 2 * used + 10) return std::nullopt;
  Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(figure.data(), n);
  y.array() -= y.mean();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x.leftCols(used));
  if (qr.rank() < used) return std::nullopt;
  const Eigen::VectorXd slope = qr.solve(y);
  const double freedom = static_cast<double>(n - used - 1);
  const double left = (y - x.leftCols(used) * slope).squaredNorm() / freedom;
  const Eigen::MatrixXd inverse = (x.leftCols(used).transpose() * x.leftCols(used)).inverse();
  Sensitivity result;
  result.effects.resize(static_cast<std::size_t>(all));
  for (Eigen::Index p = 0; p < used; ++p) {
    result.effects[static_cast<std::size_t>(varying[static_cast<std::size_t>(p)])] = {slope[p],
                                                                                      std::sqrt(left * inverse(p, p))};
  }
  const double variance = y.squaredNorm() / static_cast<double>(n - 1);
  result.residual = std::sqrt(left);
  result.explained = variance > 0.0 ? std::max(0.0, 1.0 - left / variance) : 0.0;
  return result;
}

}  // namespace evenglow::design
