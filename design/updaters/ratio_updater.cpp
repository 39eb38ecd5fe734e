#include "design/updaters/ratio_updater.h"

#include <algorithm>
#include <cmath>

#include "design/updaters/level.h"

namespace evenglow::design {
namespace {

constexpr double kLargestRatio = 4.0;

class RatioUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec) const override {
    core::CellField excess = state.observation.map.luminance;
    const double mean = excess.mean();
    // A cell that no light reached yet wants the largest ratio.
    for (double& value : excess.values) value = std::log(std::max(value / mean, 1e-6));
    return apply_ratio(state, spec, excess);
  }
};

}  // namespace

Proposal apply_ratio(const DesignState& state, const DesignSpec& spec, const core::CellField& log_excess) {
  const double limit = std::log(kLargestRatio);
  core::CellField factor = log_excess;
  for (double& value : factor.values) value = std::clamp(-spec.power * value, -limit, limit);
  factor = core::resample_bilinear(factor, state.density.cells.grid);
  tracer::DensityField shape = state.density;
  for (std::size_t i = 0; i < shape.cells.values.size(); ++i) shape.cells.values[i] *= std::exp(factor.values[i]);
  return with_level(std::move(shape), state.density.cells.mean(), spec);
}

std::unique_ptr<const Updater> make_ratio_updater() {
  return std::make_unique<RatioUpdater>();
}

}  // namespace evenglow::design
