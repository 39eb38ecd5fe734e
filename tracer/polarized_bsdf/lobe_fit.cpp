#include "tracer/polarized_bsdf/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/polarized_bsdf/lobe_luminance.h"

namespace evenglow::tracer {
namespace {

/// What is fitted: logarithms of what must be positive, then the offsets. a1 and b1 follow from the energy.
constexpr int kLogs = 18, kFree = 20, kThroughput = 17;
using Free = std::array<double, kFree>;

template <typename T>
using Member = T LobeValues<T>::*;

/// The positive ones, in the order of the fit.
template <typename T>
const std::array<Member<T>, kLogs>& logs() {
  using V = LobeValues<T>;
  static const std::array<Member<T>, kLogs> members{&V::sx, &V::sy, &V::s2, &V::s3p, &V::s3b, &V::p1,
                                                    &V::p3, &V::b2, &V::b3, &V::t1,  &V::t2,  &V::t3,
                                                    &V::a2, &V::a3, &V::a2b, &V::a3b, &V::e0, &V::throughput};
  return members;
}

constexpr std::array<const char*, kFree> kNames{
    "sx", "sy",           "s2",           "s3p",           "s3b",          "p1_cd_m2", "p3_cd_m2",
    "b2_cd_m2", "b3_cd_m2", "t1",           "t2",            "t3",           "a2_pass_cd_m2", "a3_pass_cd_m2",
    "a2_block_cd_m2", "a3_block_cd_m2", "e0_lx", "throughput", "offset_reflection_deg", "offset_transmission_deg"};

template <typename T>
LobeValues<T> values_of(const T* x, double absorption) {
  using std::exp;
  LobeValues<T> v;
  for (std::size_t i = 0; i < kLogs; ++i) v.*logs<T>()[i] = exp(x[i]);
  v.offset_reflection = x[kLogs];
  v.offset_transmission = x[kLogs + 1];
  constrain_energy(v, absorption);
  return v;
}

double error_of(const LuminanceRow& row, const LobeFitOptions& options) {
  return options.relative_error * row.measured + options.absolute_error;
}

/// One reading, in errors.
struct Reading {
  ScatterKind kind;
  LuminanceRow row;
  double error;
  double absorption;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    const LobeValues<T> v = values_of(x, absorption);
    if (!(v.a1 > T(0.0)) || !(v.b1 > T(0.0))) return false;  // no film: the solver takes a shorter step
    residual[0] = (lobe_luminance(v, kind, row) - row.measured) / error;
    return true;
  }
};

std::vector<Reading> readings_of(const LuminanceTable& reflection, const LuminanceTable& transmission,
                                 const LobeFitOptions& options) {
  std::vector<Reading> readings;
  for (const LuminanceTable* table : {&reflection, &transmission}) {
    for (const LuminanceRow& row : table->rows) {
      readings.push_back({table->kind, row, error_of(row, options), options.absorption});
    }
  }
  return readings;
}

LobeValues<double> to_values(const LobeParameters& p, const LuminanceSetup& s) {
  return {p.sx, p.sy, p.s2, p.s3p, p.s3b, p.p1, p.p3, p.b1, p.b2, p.b3, p.t1, p.t2, p.t3, p.a1, p.a2, p.a3, p.a2b,
          p.a3b, p.e0, s.throughput, s.offset_reflection, s.offset_transmission};
}

LobeParameters to_parameters(const LobeValues<double>& v, const LobeFitOptions& options) {
  LobeParameters p{v.sx, v.sy, v.s2, v.s3p, v.s3b, v.p1, v.p3, v.b1, v.b2, v.b3, v.t1, v.t2, v.t3, v.a1, v.a2, v.a3,
                   v.a2b, v.a3b, v.e0};
  p.absorption = options.absorption;
  p.refractive_index = options.start.refractive_index;
  return p;
}

/// The start with amplitudes that fit the sum of the readings, and an e0 that leaves room for a1 and b1.
Free start_of(const std::vector<Reading>& readings, const LobeFitOptions& options) {
  LuminanceSetup setup;
  if (options.throughput) setup.throughput = *options.throughput;
  LobeValues<double> v = to_values(options.start, setup);
  double measured = 0.0, simulated = 0.0;
  for (const Reading& reading : readings) {
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
  Free x{};
  for (std::size_t i = 0; i < kLogs; ++i) x[i] = std::log(v.*logs<double>()[i]);
  return x;
}

struct Solution {
  Free x{};
  Eigen::MatrixXd jacobian;  ///< residuals x kFree
  double chi_square = 0.0;   ///< without the loss
  double scatter = 1.0;      ///< factor of (J^T J)^-1 that makes it the covariance
  int iterations = 0;
  bool converged = false;
};

/// Jacobian and scatter at the solution. With a loss rho(r) the covariance of an M-estimate is (Huber, Robust
/// Statistics, 1981, section 7.6)
///
///     [sum psi^2 / (n - p)] / [mean psi']^2 (J^T J)^-1,     psi = r / (1 + r^2/w^2)     (Cauchy),
///
/// which for psi = r is the usual one.
void differentiate(const std::vector<Reading>& readings, const LobeFitOptions& options, Solution& solution) {
  const auto n = static_cast<double>(readings.size());
  solution.jacobian.resize(static_cast<Eigen::Index>(readings.size()), kFree);
  double squares = 0.0, slopes = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const ceres::AutoDiffCostFunction<Reading, 1, kFree> cost(new Reading(readings[i]));
    Free gradient{};
    const double* x = solution.x.data();
    double* row = gradient.data();
    double r = 0.0;
    cost.Evaluate(&x, &r, &row);
    const double q = options.loss_width > 0.0 ? std::pow(r / options.loss_width, 2) : 0.0;
    solution.chi_square += r * r;
    squares += std::pow(r / (1.0 + q), 2);
    slopes += (1.0 - q) / ((1.0 + q) * (1.0 + q));
    for (int j = 0; j < kFree; ++j) {
      solution.jacobian(static_cast<Eigen::Index>(i), j) = gradient[static_cast<std::size_t>(j)];
    }
  }
  if (options.throughput) solution.jacobian.col(kThroughput).setZero();
  const double free = kFree - (options.throughput ? 1 : 0);
  solution.scatter = squares / (n - free) / std::pow(slopes / n, 2);
}

Solution solve(const std::vector<Reading>& readings, const Free& start, const LobeFitOptions& options) {
  Solution solution;
  solution.x = start;
  ceres::Problem problem;
  for (const Reading& reading : readings) {
    auto* cost = new ceres::AutoDiffCostFunction<Reading, 1, kFree>(new Reading(reading));  // owned by the problem
    problem.AddResidualBlock(cost, options.loss_width > 0.0 ? new ceres::CauchyLoss(options.loss_width) : nullptr,
                             solution.x.data());
  }
  if (options.throughput) {
    problem.SetManifold(solution.x.data(), new ceres::SubsetManifold(kFree, {kThroughput}));
  }
  // Beyond these bounds a lobe is no lobe: widths 0.01 to 2, amplitudes and e0 below 1e9.
  for (int i = 0; i < kLogs && !options.throughput; ++i) {
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

constexpr double kUnknown = 1.0;  ///< relative error (or rad) from which a combination counts as not told

/// Covariance of the free parameters; directions that the readings do not tell have an infinite error.
struct Covariance {
  Eigen::MatrixXd matrix;
  std::vector<bool> unknown;
  std::vector<std::string> remarks;
};

Covariance covariance_of(const Solution& solution, bool throughput_held) {
  const double scatter = solution.scatter;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(solution.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Covariance result{Eigen::MatrixXd::Zero(kFree, kFree), std::vector<bool>(kFree, false), {}};
  const double largest = svd.singularValues()[0];
  for (Eigen::Index k = 0; k < kFree; ++k) {
    const double s = svd.singularValues()[k];
    const Eigen::VectorXd v = svd.matrixV().col(k);
    if (throughput_held && std::abs(v[kThroughput]) > 0.999999) continue;
    const bool lost = s < 1e-10 * largest;
    if (!lost) result.matrix += scatter / (s * s) * v * v.transpose();
    if (!lost && std::sqrt(scatter) / s < kUnknown) continue;
    std::string names;
    for (Eigen::Index i = 0; i < kFree; ++i) {
      if (std::abs(v[i]) < 0.3) continue;
      names += (names.empty() ? "" : ", ") + std::string(kNames[static_cast<std::size_t>(i)]);
      if (lost) result.unknown[static_cast<std::size_t>(i)] = true;
    }
    result.remarks.push_back(fmt::format("the readings do not tell {}: {}", names.find(',') == std::string::npos ? "" : "apart " , names) +
                             (lost ? " (no error can be given)" : fmt::format(" (relative error {:.2g})", std::sqrt(scatter) / s)));
  }
  for (Eigen::Index i = 0; i < kFree; ++i) {
    for (Eigen::Index j = i + 1; j < kFree; ++j) {
      const double correlation = result.matrix(i, j) / std::sqrt(result.matrix(i, i) * result.matrix(j, j));
      if (std::abs(correlation) < 0.98) continue;
      result.remarks.push_back(fmt::format("{} and {} can hardly be told apart (correlation {:.3f})",
                                           kNames[static_cast<std::size_t>(i)], kNames[static_cast<std::size_t>(j)], correlation));
    }
  }
  return result;
}

/// Standard error of a derived value from its derivatives.
double carried_error(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

std::vector<FittedValue> fitted_values(const Solution& solution, const Covariance& covariance,
                                       const LobeFitOptions& options) {
  using Jet = ceres::Jet<double, kFree>;
  std::array<Jet, kFree> x;
  for (int i = 0; i < kFree; ++i) x[static_cast<std::size_t>(i)] = Jet(solution.x[static_cast<std::size_t>(i)], i);
  const LobeValues<Jet> v = values_of(x.data(), options.absorption);
  std::vector<FittedValue> values;
  const auto add = [&](const std::string& key, const Jet& value, double unit) {
    values.push_back({key, value.a / unit, carried_error(value.v, covariance.matrix) / unit});
    for (std::size_t i = 0; i < kFree; ++i) {
      if (covariance.unknown[i] && value.v[static_cast<Eigen::Index>(i)] != 0.0) {
        values.back().se = std::numeric_limits<double>::infinity();
      }
    }
  };
  for (std::size_t i = 0; i < kThroughput; ++i) {
    if (std::string(kNames[i]) == "b2_cd_m2") add("b1_cd_m2", v.b1, 1.0);
    if (std::string(kNames[i]) == "a2_pass_cd_m2") add("a1_pass_cd_m2", v.a1, 1.0);
    add(kNames[i], v.*logs<Jet>()[i], 1.0);
  }
  add(kNames[kThroughput], v.throughput, 1.0);
  add(kNames[kLogs], v.offset_reflection, core::kRadPerDeg);
  add(kNames[kLogs + 1], v.offset_transmission, core::kRadPerDeg);
  return values;
}

LuminanceMetrics metrics_of(const LuminanceTable& table, const LobeParameters& parameters, const LuminanceSetup& setup) {
  std::vector<LuminancePair> pairs;
  for (const LuminanceRow& row : table.rows) {
    pairs.push_back({row.theta, row.measured, lobe_luminance(parameters, setup, table.kind, row)});
  }
  return luminance_metrics(pairs);
}

}  // namespace

double lobe_luminance(const LobeParameters& parameters, const LuminanceSetup& setup, ScatterKind kind,
                      const LuminanceRow& row) {
  return lobe_luminance(to_values(parameters, setup), kind, row);
}

LobeFit fit_lobes(const LuminanceTable& reflection, const LuminanceTable& transmission, const LobeFitOptions& options) {
  const std::vector<Reading> readings = readings_of(reflection, transmission, options);
  const int free = kFree - (options.throughput ? 1 : 0);
  if (static_cast<int>(readings.size()) <= free) {
    throw core::Error(fmt::format("a fit of {} parameters needs more readings than that, got {}", free, readings.size()));
  }
  const Solution solution = solve(readings, start_of(readings, options), options);
  LobeFit fit;
  const LobeValues<double> v = values_of(solution.x.data(), options.absorption);
  fit.parameters = to_parameters(v, options);
  fit.setup = {v.throughput, v.offset_reflection, v.offset_transmission};
  fit.chi_square = solution.chi_square;
  fit.degrees_of_freedom = static_cast<int>(readings.size()) - free;
  fit.iterations = solution.iterations;
  fit.converged = solution.converged;
  const Covariance covariance = covariance_of(solution, options.throughput.has_value());
  fit.values = fitted_values(solution, covariance, options);
  fit.remarks = covariance.remarks;
  fit.reflection = metrics_of(reflection, fit.parameters, fit.setup);
  fit.transmission = metrics_of(transmission, fit.parameters, fit.setup);
  return fit;
}

CrossValidation cross_validate(const LuminanceTable& reflection, const LuminanceTable& transmission,
                               const LobeFitOptions& options, int folds, std::uint64_t seed) {
  const std::vector<Reading> readings = readings_of(reflection, transmission, options);
  core::expects(folds >= 2 && static_cast<std::size_t>(folds) <= readings.size(), "2 <= folds <= readings");
  std::vector<std::size_t> order(readings.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  core::PhotonRng rng({seed, 0, 0}, 0);
  for (std::size_t i = order.size() - 1; i > 0; --i) {  // Fisher and Yates
    std::swap(order[i], order[static_cast<std::size_t>(rng.uniform() * static_cast<double>(i + 1))]);
  }
  CrossValidation result;
  result.folds = folds;
  std::array<std::vector<LuminancePair>, 2> pairs;
  for (int fold = 0; fold < folds; ++fold) {
    std::vector<Reading> kept, held;
    for (std::size_t i = 0; i < order.size(); ++i) {
      (static_cast<int>(i % static_cast<std::size_t>(folds)) == fold ? held : kept).push_back(readings[order[i]]);
    }
    const Solution solution = solve(kept, start_of(readings, options), options);
    const LobeValues<double> v = values_of(solution.x.data(), options.absorption);
    for (const Reading& reading : held) {
      const double L = lobe_luminance(v, reading.kind, reading.row);
      pairs[static_cast<std::size_t>(reading.kind)].push_back({reading.row.theta, reading.row.measured, L});
      result.chi_square += std::pow((L - reading.row.measured) / reading.error, 2);
    }
  }
  result.reflection = luminance_metrics(pairs[0]);
  result.transmission = luminance_metrics(pairs[1]);
  result.chi_square /= static_cast<double>(readings.size());
  return result;
}

}  // namespace evenglow::tracer
