#include "design/updaters/auto_updater.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "design/updaters/anderson_updater.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "design/updaters/path_reuse_updater.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

constexpr double kSlow = 0.35;     // of the RMS in a step
constexpr double kExplains = 4.0;  // times the noise of the step before, in squares
constexpr double kLinear = 0.3;    // RMS below which slowness speaks of coupling, not of a far start
constexpr int kTrials = 2;
constexpr double kRecorded = 0.01;  // of the photons

constexpr const char* kState = "auto";
/// Entries of kState: squared RMS of the last step, noise in its update, accelerating (0, 1), times given up.
enum Entry { kSquare, kNoise, kAccelerating, kGivenUp, kEntries };

double square_of(const StepRecord& record) {
  return record.rms_corrected.value * std::abs(record.rms_corrected.value);
}

double square_se(const StepRecord& record) {
  return 2.0 * std::max(std::abs(record.rms_corrected.value), record.rms_corrected.se) * record.rms_corrected.se;
}

/// Changes the method where the last step asks for it; says so.
std::string choose(const StepRecord& record, std::vector<double>& state) {
  const double square = square_of(record);
  const double se = square_se(record);
  const double contraction = std::sqrt(std::max(0.0, square) / std::max(state[kSquare], 1e-300));
  if (state[kAccelerating] > 0.0) {
    if (square <= 1.5 * state[kSquare] + 3.0 * se) return {};
    state[kAccelerating] = 0.0;
    ++state[kGivenUp];
    return fmt::format("auto: the RMS rose to {:.2f} times its last value: back to ratio_noise_aware.", contraction);
  }
  const bool significant =
      square > 3.0 * se && square > kExplains * state[kNoise] && state[kSquare] < kLinear * kLinear;
  if (contraction < kSlow || !significant || state[kGivenUp] >= kTrials) return {};
  state[kAccelerating] = 1.0;
  return fmt::format(
      "auto: the RMS fell to {:.2f} of its last value only, which noise does not explain: the cells are coupled, on "
      "with anderson.",
      contraction);
}

/// Do the histories of the step fit the memory, or as many as tell small changes of the density (reused_histories.h)?
bool enough_records(const DesignState& state) {
  if (state.recorded.empty()) return false;
  const RecordedTrace& newest = state.recorded.back();
  return static_cast<double>(newest.records->photons()) >= kRecorded * static_cast<double>(newest.photons);
}

class AutoUpdater final : public Updater {
 public:
  bool wants_records() const override { return true; }
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory& memory) const override {
    if (enough_records(state)) return reuse_paths(state, spec);
    const Denoised excess = noise_aware_excess(state);
    const core::CellField residual = ratio_step(state, spec, excess.field);
    auto& own = memory[kState];
    std::string note;
    if (own.size() == kEntries) {
      note = choose(state.record, own);
    } else {
      own = {0.0, 0.0, 0.0, 0.0};
    }
    own[kSquare] = square_of(state.record);
    own[kNoise] = excess.noise_square();
    const bool accelerate = own[kAccelerating] > 0.0;
    Proposal proposal = take_step(state, spec, anderson_step(residual, own[kNoise], state, spec, accelerate, memory));
    proposal.method = accelerate ? "anderson" : "ratio_noise_aware";
    proposal.note = std::move(note);
    return proposal;
  }
};

}  // namespace

std::unique_ptr<const Updater> make_auto_updater() {
  return std::make_unique<AutoUpdater>();
}

}  // namespace evenglow::design
