#include "design/updaters/stochastic_approximation_updater.h"

#include "design/updaters/log_step.h"

namespace evenglow::design {
namespace {

constexpr const char* kErrors = "kesten.errors";
constexpr const char* kChanges = "kesten.changes";

class StochasticApproximationUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory& memory) const override {
    core::CellField step = ratio_step(state, spec, log_excess(state));
    const std::size_t cells = step.values.size();
    auto& errors = memory[kErrors];
    auto& changes = memory[kChanges];
    errors.resize(cells, 0.0);
    changes.resize(cells, 0.0);
    for (std::size_t i = 0; i < cells; ++i) {
      if (errors[i] * step.values[i] < 0.0) ++changes[i];
      errors[i] = step.values[i];
      step.values[i] /= 1.0 + changes[i];
    }
    return take_step(state, spec, step);
  }

  int patience(const DesignSpec&) const override { return 8; }
};

}  // namespace

std::unique_ptr<const Updater> make_stochastic_approximation_updater() {
  return std::make_unique<StochasticApproximationUpdater>();
}

}  // namespace evenglow::design
