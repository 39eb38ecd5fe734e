#include "design/updaters/coarse_newton_updater.h"

#include <algorithm>
#include <cmath>

#include <ceres/ceres.h>
#include <fmt/core.h>

#include "design/updaters/coarse_basis.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "design/updaters/reused_histories.h"

namespace evenglow::design {
namespace {

constexpr double kLinear = 0.3;    // RMS of the excess
constexpr double kLargest = 1.38;  // ln 4
constexpr double kLeastRidge = 1e-6;

using Index = Eigen::Index;

/// residual + J c above, ridge^1/2 c below.
class LinearResiduals final : public ceres::CostFunction {
 public:
  explicit LinearResiduals(const CoarseProblem& problem) : problem_(problem), roots_(problem.ridge.cwiseSqrt()) {
    set_num_residuals(static_cast<int>(problem.jacobian.rows() + problem.jacobian.cols()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.jacobian.cols()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Index rows = problem_.jacobian.rows(), nodes = problem_.jacobian.cols();
    const Eigen::Map<const Eigen::VectorXd> c(parameters[0], nodes);
    Eigen::Map<Eigen::VectorXd> out(residuals, rows + nodes);
    out.head(rows) = problem_.residual + problem_.jacobian * c;
    out.tail(nodes) = roots_.cwiseProduct(c);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> slopes(jacobians[0], rows + nodes, nodes);
    slopes.topRows(rows) = problem_.jacobian;
    slopes.bottomRows(nodes) = roots_.asDiagonal().toDenseMatrix();
    return true;
  }

 private:
  const CoarseProblem& problem_;
  Eigen::VectorXd roots_;
};

double rms_of(const core::CellField& field) {
  double sum = 0.0;
  for (const double value : field.values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(field.values.size()));
}

/// Rows of the display: what they hold, and the cells of each.
struct Rows {
  std::vector<std::uint32_t> of_bin;
  Eigen::VectorXd cells, excess, luminance, change;
};

/// `change`: of the luminance, by the ratio step.
Rows rows_of(const CoarseBasis& basis, const core::CellField& excess, const std::vector<core::Estimate>& luminance,
             const std::vector<core::Estimate>& change) {
  const auto count = static_cast<Index>(basis.count());
  Rows rows{basis.nearest_node(excess.grid), Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count),
            Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  for (std::size_t i = 0; i < rows.of_bin.size(); ++i) {
    const auto row = static_cast<Index>(rows.of_bin[i]);
    rows.cells[row] += 1.0;
    rows.excess[row] += excess.values[i];
    rows.luminance[row] += luminance[i].value;
    rows.change[row] += change[i].value;
  }
  return rows;
}

/// Of each node, the share of the density that its tent holds.
Eigen::VectorXd density_shares(const core::CellField& density, const CoarseBasis& basis) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(static_cast<Index>(basis.count()));
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    for (const auto& part : basis.directions().of_cell[i])
      shares[static_cast<Index>(part.direction)] += static_cast<double>(part.weight) * density.values[i];
  }
  return shares / shares.sum();
}

/// The step less what it would change the mean density, which is taken back (level.h).
core::CellField at_level(core::CellField step, const core::CellField& density) {
  double sum = 0.0;
  for (std::size_t i = 0; i < step.values.size(); ++i) sum += step.values[i] * density.values[i];
  const double mean = sum / (density.mean() * static_cast<double>(density.values.size()));
  for (double& value : step.values) value -= mean;
  return step;
}

/// Ratio steps beside what the coarse grid says of them.
CoarseProblem coarse_problem(const DesignState& state, const CoarseBasis& basis, const core::CellField& excess,
                             const core::CellField& ratio) {
  const tracer::ArrivalRecords& records = *state.recorded.back().records;
  const Rows rows = rows_of(basis, excess, records.at(state.density).luminance.totals(),
                            records.derivative(state.density, ratio).totals());
  tracer::RecordedSlopes slopes = records.jacobian(state.density, basis.directions(), rows.of_bin, basis.count());
  const auto nodes = static_cast<Index>(basis.count());
  CoarseProblem problem;
  problem.ridge = Eigen::VectorXd::Zero(nodes);
  Eigen::VectorXd weights = rows.cells / rows.cells.sum();
  Eigen::VectorXd e = Eigen::VectorXd::Zero(nodes);
  for (Index row = 0; row < nodes; ++row) {
    if (!(rows.luminance[row] > 0.0)) {  // no display there, or no light
      weights[row] = 0.0;
      slopes.mean.row(row).setZero();
      continue;
    }
    e[row] = rows.excess[row] / rows.cells[row] + rows.change[row] / rows.luminance[row];
    slopes.mean.row(row) /= rows.luminance[row];
    problem.ridge += weights[row] * slopes.variance.row(row).transpose() / std::pow(rows.luminance[row], 2);
  }
  weights /= weights.sum();
  problem.jacobian = slopes.mean.rowwise() - (weights.transpose() * slopes.mean).eval();  // the mean is no excess
  // Nor does the level change: a correction of all cells alike is taken back.
  const Eigen::VectorXd shares = density_shares(state.density.cells, basis);
  problem.jacobian -= (problem.jacobian.rowwise().sum() * shares.transpose()).eval();
  const std::vector<double> step = basis.means(ratio);
  problem.proposed = Eigen::Map<const Eigen::VectorXd>(step.data(), nodes);
  e.array() -= weights.dot(e);
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  problem.residual = roots.cwiseProduct(e);
  problem.jacobian = (roots.asDiagonal() * problem.jacobian).eval();
  problem.ridge.array() += kLeastRidge * problem.jacobian.squaredNorm() / static_cast<double>(nodes);
  problem.largest_step = kLargest;
  return problem;
}

class CoarseNewtonUpdater final : public Updater {
 public:
  bool wants_records() const override { return true; }
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory&) const override {
    const bool recorded = !state.recorded.empty();
    const DesignState seen = recorded ? ReusedHistories(state, spec).at(state.density).state : state;
    const Denoised excess = noise_aware_excess(seen);
    core::CellField step = ratio_step(seen, spec, excess.field);
    const bool newton = recorded && rms_of(excess.field) < kLinear;
    if (newton) {
      const core::CellGrid& cells = state.density.cells.grid;
      const CoarseBasis basis(cells, std::min(spec.coarse_newton.nx, cells.nx),
                              std::min(spec.coarse_newton.ny, cells.ny));
      const core::CellField correction =
          basis.field(solve(coarse_problem(state, basis, excess.field, at_level(step, state.density.cells))));
      for (std::size_t i = 0; i < step.values.size(); ++i) step.values[i] += correction.values[i];
    }
    Proposal proposal = take_step(state, spec, step);
    proposal.noise_left = std::sqrt(excess.noise_square());
    proposal.method = newton ? "coarse_newton" : "ratio_noise_aware";
    return proposal;
  }
};

}  // namespace

std::vector<double> solve(const CoarseProblem& problem) {
  const Index nodes = problem.jacobian.cols();
  std::vector<double> c(static_cast<std::size_t>(nodes), 0.0);
  ceres::Problem::Options borrowed;
  borrowed.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  LinearResiduals cost(problem);
  ceres::Problem least_squares(borrowed);
  least_squares.AddResidualBlock(&cost, nullptr, c.data());
  for (Index j = 0; j < nodes; ++j) {
    const double p = std::clamp(problem.proposed[j], -problem.largest_step, problem.largest_step);
    least_squares.SetParameterLowerBound(c.data(), static_cast<int>(j), -problem.largest_step - p);
    least_squares.SetParameterUpperBound(c.data(), static_cast<int>(j), problem.largest_step - p);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.initial_trust_region_radius = 1e8;  // linear: the first step is the solution, but for the bounds
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &least_squares, &summary);
  return c;
}

std::unique_ptr<const Updater> make_coarse_newton_updater() {
  return std::make_unique<CoarseNewtonUpdater>();
}

}  // namespace evenglow::design
