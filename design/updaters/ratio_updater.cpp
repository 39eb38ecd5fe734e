#include "design/updaters/ratio_updater.h"

#include "design/updaters/log_step.h"

namespace evenglow::design {
namespace {

class RatioUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory&) const override {
    return take_step(state, spec, ratio_step(state, spec, log_excess(state)));
  }
};

}  // namespace

std::unique_ptr<const Updater> make_ratio_updater() {
  return std::make_unique<RatioUpdater>();
}

}  // namespace evenglow::design
