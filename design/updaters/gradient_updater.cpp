#include "design/updaters/gradient_updater.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <nlopt.hpp>

#include "design/problem/density_limits.h"
#include "design/updaters/history_merit.h"
#include "design/updaters/level.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"

namespace evenglow::design {
namespace {

constexpr double kLeastShare = 0.25;
constexpr double kLargest = 1.38;  // ln 4, of a step

/// The search runs in z = (x - x0) sqrt(2/n), x = ln density: there the Hessian of a plate without coupling is about 1.
class Search {
 public:
  Search(const DesignState& state, const DesignSpec& spec)
      : merit_(state, spec),
        start_(state.density),
        limits_(cell_limits(spec, state.density.cells.grid)),
        unit_(std::sqrt(0.5 * static_cast<double>(state.density.cells.values.size()))) {}

  /// The best density that was evaluated, the start apart.
  std::optional<tracer::DensityField> run(const GradientSpec& spec, double noise_square) {
    const std::size_t cells = start_.cells.values.size();
    nlopt::opt search(spec.method == "mma" ? nlopt::LD_MMA : nlopt::LD_LBFGS, static_cast<unsigned>(cells));
    std::vector<double> low(cells), high(cells), z(cells, 0.0);
    for (std::size_t i = 0; i < cells; ++i) {
      const double now = start_.cells.values[i];
      low[i] = std::min(0.0, std::max(-kLargest, std::log(limits_.least.values[i] / now))) / unit_;
      high[i] = std::max(0.0, std::min(kLargest, std::log(limits_.largest.values[i] / now))) / unit_;
    }
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    search.set_min_objective([](const std::vector<double>& at, std::vector<double>& slope,
                                void* data) { return static_cast<Search*>(data)->value(at, slope); },
                             this);
    search.set_stopval(noise_square);
    search.set_maxeval(spec.evaluations);
    double least = 0.0;
    try {
      search.optimize(z, least);
    } catch (const nlopt::forced_stop&) {
      end_ = "the histories are worth no more there";
    } catch (const nlopt::roundoff_limited&) {
    } catch (const std::runtime_error&) {  // a line search that finds no way on
    }
    if (evaluations_ >= spec.evaluations) end_ = "that is all that may be made";
    return std::move(best_);
  }

  int evaluations() const { return evaluations_; }
  const char* end() const { return end_; }
  double least() const { return least_; }

 private:
  double value(const std::vector<double>& z, std::vector<double>& slope) {
    tracer::DensityField density = start_;
    for (std::size_t i = 0; i < z.size(); ++i) density.cells.values[i] *= std::exp(unit_ * z[i]);
    const HistoryMerit::Value found = merit_.at(density);
    if (found.effective_share < kLeastShare) throw nlopt::forced_stop();
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = unit_ * found.gradient.values[i];
    if (evaluations_++ == 0) {
      least_ = found.merit;
    } else if (found.merit < least_) {
      least_ = found.merit;
      best_ = std::move(density);
    }
    return found.merit;
  }

  HistoryMerit merit_;
  const tracer::DensityField& start_;
  CellLimits limits_;
  double unit_;
  int evaluations_ = 0;
  double least_ = 0.0;
  std::optional<tracer::DensityField> best_;
  const char* end_ = "what is left is noise";
};

class GradientUpdater final : public Updater {
 public:
  bool wants_records() const override { return true; }
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory&) const override {
    if (state.recorded.empty()) return ratio(state, spec);
    Search search(state, spec);
    auto found = search.run(spec.gradient, state.record.noise * state.record.noise);
    Proposal proposal = found ? with_level(std::move(*found), state.density.cells.mean(), spec) : ratio(state, spec);
    if (found) proposal.method = "gradient";
    proposal.note = fmt::format("gradient: {} evaluations, RMS with noise {:.2f} % there; {}.{}", search.evaluations(),
                                100.0 * std::sqrt(std::max(0.0, search.least())), search.end(),
                                found ? "" : " A ratio step instead.");
    return proposal;
  }

 private:
  static Proposal ratio(const DesignState& state, const DesignSpec& spec) {
    Proposal proposal = take_step(state, spec, ratio_step(state, spec, noise_aware_excess(state).field));
    proposal.method = "ratio_noise_aware";
    return proposal;
  }
};

}  // namespace

std::unique_ptr<const Updater> make_gradient_updater() {
  return std::make_unique<GradientUpdater>();
}

}  // namespace evenglow::design
