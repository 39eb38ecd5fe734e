#pragma once

#include <vector>

#include <Eigen/Core>

#include "design/updaters/updater.h"

namespace evenglow::design {

/// A Gauss-Newton step on a coarse grid, for what couples the cells is smooth: light that a cell lets out is missing
/// far away, and light that a film returns comes out elsewhere. The ratio update, which takes every cell for itself,
/// does the rest.
///
/// The Jacobian d ln L_row / d x_node comes from the histories of the trace (score function; ArrivalRecords::jacobian;
/// Rubinstein and Shapiro, Discrete Event Systems, 1993), nodes = tents in ln density (coarse_basis.h), rows = the
/// cells of the display that lie nearest to each node. With e the excess ln(L / mean L) of a row and p the ratio step,
/// the correction c of the nodes solves
///
///     min |e + L'(p) + J c|^2 + sum_j v_j c_j^2        |p + c| <= ln 4
///
/// with L'(p) the derivative of ln L of the rows along the ratio step of all cells (ArrivalRecords::derivative).
///
/// (Ceres, dense QR within bounds), where J holds that the mean density is kept. v_j: sum over the rows of the variance
/// of J's column, from its batches: what the trace cannot tell is left to the ratio step. While the RMS of e is above
/// 30 % the map is far from linear, and the step is the ratio step; the same without records.
std::unique_ptr<const Updater> make_coarse_newton_updater();

/// The least-squares problem of the step; all arguments have one row for each row of `jacobian`, or one for each
/// column.
struct CoarseProblem {
  Eigen::MatrixXd jacobian;   ///< rows x nodes
  Eigen::VectorXd ridge;      ///< of each node, >= 0
  Eigen::VectorXd residual;   ///< e + L'(p)
  Eigen::VectorXd proposed;   ///< p at the nodes
  double largest_step = 1.0;  ///< of |p + c|
};
std::vector<double> solve(const CoarseProblem& problem);

}  // namespace evenglow::design
