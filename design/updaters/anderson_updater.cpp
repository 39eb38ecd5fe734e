#include "design/updaters/anderson_updater.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

#include "design/problem/density_limits.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"

namespace evenglow::design {
namespace {

constexpr double kRidge = 1e-6;      // of the mean square of the differences
constexpr double kMostGamma = 6.0;   // sum of |gamma|
constexpr double kLinear = 0.3;      // RMS of a residual up to which the map is close to linear
constexpr double kLevelMoved = 0.2;  // in ln mean density
constexpr double kWorse = 1.1;       // of the squared RMS, beside two standard errors

// Names in the memory.
constexpr const char* kPoints = "anderson.x";
constexpr const char* kResiduals = "anderson.f";
constexpr const char* kJudged = "anderson.judged";  // squared RMS, its error, ln level, accelerated

using Vector = Eigen::VectorXd;
using Block = Eigen::Map<const Vector>;

void forget(UpdaterMemory& memory) {
  memory.erase(kPoints);
  memory.erase(kResiduals);
}

/// Appends a vector to a list of vectors of its length; the oldest goes when there are more than `most`.
void append(std::vector<double>& list, const std::vector<double>& last, std::size_t most) {
  if (list.size() >= most * last.size())
    list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(last.size()));
  list.insert(list.end(), last.begin(), last.end());
}

std::vector<double> log_shape(const core::CellField& density) {
  std::vector<double> x;
  double mean = 0.0;
  for (const double value : density.values) {
    x.push_back(std::log(value));
    mean += x.back() / static_cast<double>(density.values.size());
  }
  for (double& value : x) value -= mean;
  return x;
}

/// 1 for cells that can move, 0 for those at a limit.
Vector free_cells(const DesignState& state, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, state.density.cells.grid);
  Vector result(static_cast<Eigen::Index>(state.density.cells.values.size()));
  for (std::size_t i = 0; i < state.density.cells.values.size(); ++i) {
    const double density = state.density.cells.values[i];
    const bool held =
        density <= limits.least.values[i] * (1.0 + 1e-9) || density >= limits.largest.values[i] * (1.0 - 1e-9);
    result[static_cast<Eigen::Index>(i)] = held ? 0.0 : 1.0;
  }
  return result;
}

/// Drops what misleads.
void judge(const DesignState& state, UpdaterMemory& memory) {
  const double rms = state.record.rms_corrected.value;
  const double square = rms * std::abs(rms);
  const double se = 2.0 * std::abs(rms) * state.record.rms_corrected.se;
  const double level = std::log(state.density.cells.mean());
  const auto last = memory.find(kJudged);
  if (last != memory.end() && last->second.size() == 4) {  // a state may come from anyone
    const std::vector<double>& j = last->second;
    const bool worse = j[3] > 0.0 && square > kWorse * j[0] + 2.0 * std::hypot(se, j[1]);
    if (worse || std::abs(level - j[2]) > kLevelMoved) forget(memory);
  }
  memory[kJudged] = {square, se, level, 0.0};
}

struct Differences {
  Eigen::MatrixXd points, residuals;
};

Differences differences(const std::vector<double>& points, const std::vector<double>& residuals, std::size_t cells) {
  const std::size_t count = points.size() / cells - 1;
  const auto n = static_cast<Eigen::Index>(cells);
  Differences d{{n, static_cast<Eigen::Index>(count)}, {n, static_cast<Eigen::Index>(count)}};
  for (std::size_t j = 0; j < count; ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    d.points.col(column) = Block(points.data() + (j + 1) * cells, n) - Block(points.data() + j * cells, n);
    d.residuals.col(column) = Block(residuals.data() + (j + 1) * cells, n) - Block(residuals.data() + j * cells, n);
  }
  return d;
}

/// The coefficients of the differences; the newest is the last.
Vector combine(const Differences& d, const Vector& residual, const Vector& free, double noise_square) {
  const Eigen::MatrixXd weighted = free.asDiagonal() * d.residuals;
  Eigen::MatrixXd gram = weighted.transpose() * weighted;
  const double scale = gram.trace() / static_cast<double>(gram.rows());
  if (!(scale > 0.0)) return Vector::Zero(gram.rows());
  gram.diagonal().array() += kRidge * scale;
  Vector product = weighted.transpose() * residual;
  // The newest difference holds f_k itself: its own noise must not pass for something to be canceled.
  double& newest = product[product.size() - 1];
  const double noise = noise_square * free.sum();
  newest = std::copysign(std::max(0.0, std::abs(newest) - noise), newest);
  Vector gamma = gram.ldlt().solve(product);
  if (!gamma.allFinite()) return Vector::Zero(gram.rows());
  return gamma * std::min(1.0, kMostGamma / std::max(kMostGamma, gamma.lpNorm<1>()));
}

class AndersonUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory& memory) const override {
    const Denoised excess = noise_aware_excess(state);
    const core::CellField residual = ratio_step(state, spec, excess.field);
    return take_step(state, spec, anderson_step(residual, excess.noise_square(), state, spec, true, memory));
  }
};

}  // namespace

core::CellField anderson_step(const core::CellField& residual, double noise_square, const DesignState& state,
                              const DesignSpec& spec, bool accelerate, UpdaterMemory& memory) {
  judge(state, memory);
  const std::size_t cells = residual.values.size();
  if (memory[kPoints].size() % cells != 0 || memory[kPoints].size() != memory[kResiduals].size()) forget(memory);
  const Vector f = Block(residual.values.data(), static_cast<Eigen::Index>(cells));
  if (f.squaredNorm() > kLinear * kLinear * static_cast<double>(cells)) {
    forget(memory);
    return residual;
  }
  const auto most = static_cast<std::size_t>(spec.anderson_vectors) + 1;
  append(memory[kPoints], log_shape(state.density.cells), most);
  append(memory[kResiduals], residual.values, most);
  if (!accelerate || memory[kPoints].size() < 2 * cells) return residual;
  const Differences d = differences(memory[kPoints], memory[kResiduals], cells);
  const Vector gamma = combine(d, f, free_cells(state, spec), noise_square);
  const Vector step = f - (d.points + d.residuals) * gamma;
  memory[kJudged][3] = 1.0;
  core::CellField result = residual;
  for (std::size_t i = 0; i < cells; ++i) result.values[i] = step[static_cast<Eigen::Index>(i)];
  return result;
}

std::unique_ptr<const Updater> make_anderson_updater() {
  return std::make_unique<AndersonUpdater>();
}

}  // namespace evenglow::design
