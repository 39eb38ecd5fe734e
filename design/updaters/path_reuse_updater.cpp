#include "design/updaters/path_reuse_updater.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "design/updaters/anderson_updater.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "design/updaters/reused_histories.h"

namespace evenglow::design {
namespace {

constexpr int kInnerSteps = 12;
constexpr double kLeastShare = 0.25;
constexpr double kNoiseShare = 0.2;  // steps below this share of their noise are none

double mean_square(const core::CellField& field) {
  double sum = 0.0;
  for (const double value : field.values) sum += value * value;
  return sum / static_cast<double>(field.values.size());
}

class PathReuseUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory&) const override {
    if (!state.recorded.empty()) return reuse_paths(state, spec);
    Proposal proposal = take_step(state, spec, ratio_step(state, spec, noise_aware_excess(state).field));
    proposal.method = "ratio_noise_aware";
    return proposal;
  }
  bool wants_records() const override { return true; }
};

}  // namespace

Proposal reuse_paths(const DesignState& state, const DesignSpec& spec) {
  const ReusedHistories histories(state, spec);
  UpdaterMemory memory;  // of the inner steps; all see the same noise, so that differences of steps hold none
  ReusedView view = histories.at(state.density);
  Proposal proposal;
  double share = view.effective_share, foreseen = view.state.record.rms_corrected.value;
  int steps = 0;
  const char* end = "12 inner steps";
  for (; steps < kInnerSteps; ++steps) {
    const Denoised excess = noise_aware_excess(view.state);
    const double noise = std::sqrt(excess.noise_square());
    const core::CellField residual = ratio_step(view.state, spec, excess.field);
    const bool small = mean_square(residual) < kNoiseShare * kNoiseShare * excess.noise_square();
    const bool lost_in_noise = steps > 0 && small;
    if (lost_in_noise) {
      end = "what is left is noise";
      proposal.solved = true;
      break;
    }
    proposal = take_step(view.state, spec, anderson_step(residual, 0.0, view.state, spec, true, memory));
    proposal.noise_left = noise;
    view = histories.at(proposal.density);
    foreseen = view.state.record.rms_corrected.value;
    if (view.effective_share < kLeastShare) {
      ++steps;
      end = "the histories are worth no more there";
      break;
    }
    share = view.effective_share;
  }
  proposal.level_change = proposal.density.cells.mean() / state.density.cells.mean();
  proposal.foreseen_rms = std::max(foreseen, 0.0);
  proposal.method = "path_reuse";
  const std::string there =
      foreseen > 0.0 ? fmt::format("RMS {:.2f} %", 100.0 * foreseen) : "no RMS beyond their noise";
  proposal.note = fmt::format(
      "path_reuse: {} inner steps on the histories of {} trace{}, worth {:.0f} % of the last one; {} by these "
      "histories, {:.2f} % noise in the step; {}.",
      steps, state.recorded.size(), state.recorded.size() == 1 ? "" : "s", 100.0 * share, there,
      100.0 * proposal.noise_left.value_or(0.0), end);
  return proposal;
}

std::unique_ptr<const Updater> make_path_reuse_updater() {
  return std::make_unique<PathReuseUpdater>();
}

}  // namespace evenglow::design
