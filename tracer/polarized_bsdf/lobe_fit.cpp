#include "tracer/polarized_bsdf/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/polarized_bsdf/lobe_problem.h"

namespace evenglow::tracer {
namespace {
LobeParameters to_parameters(const LobeValues<double>& v, const LobeFitOptions& options) {
  LobeParameters p{v.sx, v.sy, v.s2, v.s3p, v.s3b, v.p1, v.p3,  v.b1,  v.b2, v.b3,
                   v.t1, v.t2, v.t3, v.a1,  v.a2,  v.a3, v.a2b, v.a3b, v.e0};
  p.absorption = options.absorption;
  p.refractive_index = options.start.refractive_index;
  return p;
}

constexpr double kUnknown = 1.0;  ///< relative error (or rad) from which a combination counts as not told

/// Covariance of the free parameters; directions that the readings do not tell have an infinite error.
struct Covariance {
  Eigen::MatrixXd matrix;
  std::vector<bool> unknown;
  std::vector<std::string> remarks;
};

Covariance covariance_of(const LobeSolution& solution, bool throughput_held) {
  const double scatter = solution.scatter;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(solution.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Covariance result{Eigen::MatrixXd::Zero(kLobeFree, kLobeFree), std::vector<bool>(kLobeFree, false), {}};
  const double largest = svd.singularValues()[0];
  for (Eigen::Index k = 0; k < kLobeFree; ++k) {
    const double s = svd.singularValues()[k];
    const Eigen::VectorXd v = svd.matrixV().col(k);
    if (throughput_held && std::abs(v[kLobeThroughput]) > 0.999999) continue;
    const bool lost = s < 1e-10 * largest;
    if (!lost) result.matrix += scatter / (s * s) * v * v.transpose();
    if (!lost && std::sqrt(scatter) / s < kUnknown) continue;
    std::string names;
    for (Eigen::Index i = 0; i < kLobeFree; ++i) {
      if (std::abs(v[i]) < 0.3) continue;
      names += (names.empty() ? "" : ", ") + std::string(kLobeNames[static_cast<std::size_t>(i)]);
      if (lost) result.unknown[static_cast<std::size_t>(i)] = true;
    }
    result.remarks.push_back(
        fmt::format("the readings do not tell {}: {}", names.find(',') == std::string::npos ? "" : "apart ", names) +
        (lost ? " (no error can be given)" : fmt::format(" (relative error {:.2g})", std::sqrt(scatter) / s)));
  }
  for (Eigen::Index i = 0; i < kLobeFree; ++i) {
    for (Eigen::Index j = i + 1; j < kLobeFree; ++j) {
      const double correlation = result.matrix(i, j) / std::sqrt(result.matrix(i, i) * result.matrix(j, j));
      if (!(std::abs(correlation) >= 0.98)) continue;  // also where one of them is held
      result.remarks.push_back(fmt::format("{} and {} can hardly be told apart (correlation {:.3f})",
                                           kLobeNames[static_cast<std::size_t>(i)],
                                           kLobeNames[static_cast<std::size_t>(j)], correlation));
    }
  }
  return result;
}

/// Standard error of a derived value from its derivatives.
double carried_error(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

std::vector<FittedValue> fitted_values(const LobeSolution& solution, const Covariance& covariance,
                                       const LobeFitOptions& options) {
  using Jet = ceres::Jet<double, kLobeFree>;
  std::array<Jet, kLobeFree> x;
  for (int i = 0; i < kLobeFree; ++i) x[static_cast<std::size_t>(i)] = Jet(solution.x[static_cast<std::size_t>(i)], i);
  const LobeValues<Jet> v = lobe_values(x.data(), options.absorption);
  std::vector<FittedValue> values;
  const auto add = [&](const std::string& key, const Jet& value, double unit) {
    values.push_back({key, value.a / unit, carried_error(value.v, covariance.matrix) / unit});
    for (std::size_t i = 0; i < kLobeFree; ++i) {
      if (covariance.unknown[i] && value.v[static_cast<Eigen::Index>(i)] != 0.0) {
        values.back().se = std::numeric_limits<double>::infinity();
      }
    }
  };
  for (std::size_t i = 0; i < kLobeThroughput; ++i) {
    if (std::string(kLobeNames[i]) == "b2_cd_m2") add("b1_cd_m2", v.b1, 1.0);
    if (std::string(kLobeNames[i]) == "a2_pass_cd_m2") add("a1_pass_cd_m2", v.a1, 1.0);
    add(kLobeNames[i], v.*lobe_logs<Jet>()[i], 1.0);
  }
  add(kLobeNames[kLobeThroughput], v.throughput, 1.0);
  add(kLobeNames[kLobeLogs], v.offset_reflection, core::kRadPerDeg);
  add(kLobeNames[kLobeLogs + 1], v.offset_transmission, core::kRadPerDeg);
  return values;
}

LuminanceMetrics metrics_of(const LuminanceTable& table, const LobeParameters& parameters,
                            const LuminanceSetup& setup) {
  std::vector<LuminancePair> pairs;
  pairs.reserve(table.rows.size());
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
  const std::vector<LobeReading> readings = lobe_readings(reflection, transmission, options);
  const int free = kLobeFree - (options.throughput ? 1 : 0);
  if (static_cast<int>(readings.size()) <= free) {
    throw core::Error(
        fmt::format("a fit of {} parameters needs more readings than that, got {}", free, readings.size()));
  }
  const LobeSolution solution = solve_lobes(readings, lobe_start(readings, options), options);
  LobeFit fit;
  const LobeValues<double> v = lobe_values(solution.x.data(), options.absorption);
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
  const std::vector<LobeReading> readings = lobe_readings(reflection, transmission, options);
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
    std::vector<LobeReading> kept, held;
    for (std::size_t i = 0; i < order.size(); ++i) {
      (static_cast<int>(i % static_cast<std::size_t>(folds)) == fold ? held : kept).push_back(readings[order[i]]);
    }
    const LobeSolution solution = solve_lobes(kept, lobe_start(readings, options), options);
    const LobeValues<double> v = lobe_values(solution.x.data(), options.absorption);
    for (const LobeReading& reading : held) {
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
