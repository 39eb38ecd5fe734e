#include "tracer/polarized_bsdf/lobe_problem.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

double error_of(const LuminanceRow& row, const LobeFitOptions& options) {
  return options.relative_error * row.measured + options.absolute_error;
}

/// Residual of one reading, in errors.
struct Residual {
  LobeReading reading;
  double absorption;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    // The analyzer loses the value of `absorption` on its way through the cost function that owns this.
    // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage)
    const LobeValues<T> v = lobe_values(x, absorption);
    if (!(v.a1 > T(0.0)) || !(v.b1 > T(0.0))) return false;  // no film: the solver takes a shorter step
    residual[0] = (lobe_luminance(v, reading.kind, reading.row) - reading.row.measured) / reading.error;
    return true;
  }
};
using Cost = ceres::AutoDiffCostFunction<Residual, 1, kLobeFree>;

/// Jacobian and scatter at the solution. With a loss rho(r) the covariance of an M-estimate is (Huber, Robust
/// Statistics, 1981, section 7.6)
///
///     K^2 [sum psi^2 / (n - p)] / [mean psi']^2 (J^T J)^-1,     psi = r / (1 + r^2/w^2)     (Cauchy),
///     K = 1 + p/n var(psi') / [mean psi']^2,
///
/// which for psi = r is the usual one. Without K the errors of 144 readings came out a sixth too small.
void differentiate(const std::vector<LobeReading>& readings, const LobeFitOptions& options, LobeSolution& solution) {
  const auto n = static_cast<double>(readings.size());
  solution.jacobian.resize(static_cast<Eigen::Index>(readings.size()), kLobeFree);
  double squares = 0.0, slopes = 0.0, squared_slopes = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Cost cost(new Residual{readings[i], options.absorption});
    LobeFree gradient{};
    const double* x = solution.x.data();
    double* row = gradient.data();
    double r = 0.0;
    cost.Evaluate(&x, &r, &row);
    const double q = options.loss_width > 0.0 ? std::pow(r / options.loss_width, 2) : 0.0;
    solution.chi_square += r * r;
    squares += std::pow(r / (1.0 + q), 2);
    const double slope = (1.0 - q) / ((1.0 + q) * (1.0 + q));
    slopes += slope;
    squared_slopes += slope * slope;
    for (int j = 0; j < kLobeFree; ++j) {
      solution.jacobian(static_cast<Eigen::Index>(i), j) = gradient[static_cast<std::size_t>(j)];
    }
  }
  if (options.throughput) solution.jacobian.col(kLobeThroughput).setZero();
  const double free = kLobeFree - (options.throughput ? 1 : 0);
  const double mean = slopes / n;
  const double k = 1.0 + free / n * (squared_slopes / n / (mean * mean) - 1.0);
  solution.scatter = k * k * squares / (n - free) / (mean * mean);
}

}  // namespace

std::vector<LobeReading> lobe_readings(const LuminanceTable& reflection, const LuminanceTable& transmission,
                                       const LobeFitOptions& options) {
  std::vector<LobeReading> readings;
  for (const LuminanceTable* table : {&reflection, &transmission}) {
    for (const LuminanceRow& row : table->rows) {
      readings.push_back({table->kind, row, error_of(row, options)});
    }
  }
  return readings;
}

LobeValues<double> to_values(const LobeParameters& p, const LuminanceSetup& s) {
  return {p.sx,
          p.sy,
          p.s2,
          p.s3p,
          p.s3b,
          p.p1,
          p.p3,
          p.b1,
          p.b2,
          p.b3,
          p.t1,
          p.t2,
          p.t3,
          p.a1,
          p.a2,
          p.a3,
          p.a2b,
          p.a3b,
          p.e0,
          s.throughput,
          s.offset_reflection,
          s.offset_transmission};
}

LobeFree lobe_start(const std::vector<LobeReading>& readings, const LobeFitOptions& options) {
  LuminanceSetup setup;
  if (options.throughput) setup.throughput = *options.throughput;
  LobeValues<double> v = to_values(options.start, setup);
  double measured = 0.0, simulated = 0.0;
  for (const LobeReading& reading : readings) {
    measured += reading.row.measured;
    simulated += lobe_luminance(v, reading.kind, reading.row);
  }
  const double scale = measured / simulated;
  core::expects(std::isfinite(scale) && scale > 0.0, "luminance tables hold light");
  for (const auto member : {&LobeValues<double>::p1, &LobeValues<double>::p3, &LobeValues<double>::b2,
                            &LobeValues<double>::b3, &LobeValues<double>::a2, &LobeValues<double>::a3,
                            &LobeValues<double>::a2b, &LobeValues<double>::a3b, &LobeValues<double>::e0}) {
    v.*member = std::max(v.*member * scale, 1e-9);
  }
  LobeFree x{};
  for (std::size_t i = 0; i < kLobeLogs; ++i) x[i] = std::log(v.*lobe_logs<double>()[i]);
  return x;
}

LobeSolution solve_lobes(const std::vector<LobeReading>& readings, const LobeFree& start,
                         const LobeFitOptions& options) {
  LobeSolution solution;
  solution.x = start;
  ceres::Problem problem;
  for (const LobeReading& reading : readings) {
    auto* cost = new Cost(new Residual{reading, options.absorption});  // owned by the problem
    problem.AddResidualBlock(cost, options.loss_width > 0.0 ? new ceres::CauchyLoss(options.loss_width) : nullptr,
                             solution.x.data());
  }
  if (options.throughput) {
    problem.SetManifold(solution.x.data(), new ceres::SubsetManifold(kLobeFree, {kLobeThroughput}));
  }
  // Beyond these bounds a lobe is no lobe: widths 0.01 to 2, amplitudes and e0 below 1e9.
  for (int i = 0; i < kLobeLogs; ++i) {
    const bool width = i < 5 || (i > 8 && i < 12);
    problem.SetParameterLowerBound(solution.x.data(), i, std::log(width ? 0.01 : 1e-9));
    problem.SetParameterUpperBound(solution.x.data(), i, std::log(width ? 2.0 : 1e9));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 2000;
  solver.function_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.termination_type == ceres::FAILURE) {
    throw core::Error("the readings give no film that keeps R + T = 1 - absorption: " + summary.message);
  }
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  solution.iterations = static_cast<int>(summary.iterations.size());
  differentiate(readings, options, solution);
  return solution;
}

}  // namespace evenglow::tracer
