#include "design/updaters/level.h"

#include <algorithm>

namespace evenglow::design {
namespace {

constexpr double kHeadroom = 0.97;  // the largest density, over the upper limit, once the level gives way
constexpr double kGiveWay = 0.8;    // the least factor of the level in a step

double scale_of(const core::CellField& shape, double current_mean, const DesignSpec& spec) {
  if (spec.level) return *spec.level / shape.mean();
  const double unchanged = current_mean / shape.mean();
  if (unchanged * shape.max() <= spec.density_max) return unchanged;
  return std::max(kGiveWay * unchanged, kHeadroom * spec.density_max / shape.max());
}

}  // namespace

Proposal with_level(tracer::DensityField shape, double current_mean, const DesignSpec& spec) {
  const double scale = scale_of(shape.cells, current_mean, spec);
  Proposal proposal;
  for (double& density : shape.cells.values) {
    density *= scale;
    if (density < spec.density_min) ++proposal.clipped_low;
    if (density > spec.density_max) ++proposal.clipped_high;
  }
  proposal.density = tracer::clamped(std::move(shape), spec.density_min, spec.density_max);
  proposal.level_change = proposal.density.cells.mean() / current_mean;
  return proposal;
}

}  // namespace evenglow::design
