#include "design/updaters/log_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/problem/regrid.h"
#include "design/updaters/level.h"

namespace evenglow::design {
namespace {

constexpr double kLargestRatio = 4.0;
constexpr double kDark = 1e-6;

}  // namespace

core::CellField log_excess(const DesignState& state) {
  core::CellField excess = state.observation.map.luminance;
  const double mean = excess.mean();
  for (double& value : excess.values) value = std::log(std::max(value / mean, kDark));
  return excess;
}

core::CellField ratio_step(const DesignState& state, const DesignSpec& spec, const core::CellField& excess) {
  const double limit = std::log(kLargestRatio);
  core::CellField step = excess;
  for (double& value : step.values) value = std::clamp(-spec.power * value, -limit, limit);
  return regrid(step, state.density.cells.grid);
}

Proposal take_step(const DesignState& state, const DesignSpec& spec, const core::CellField& step) {
  const double limit = std::log(kLargestRatio);
  tracer::DensityField shape = state.density;
  for (std::size_t i = 0; i < shape.cells.values.size(); ++i) {
    shape.cells.values[i] *= std::exp(std::clamp(step.values[i], -limit, limit));
  }
  return with_level(std::move(shape), state.density.cells.mean(), spec);
}

}  // namespace evenglow::design
