#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Brings a proposed density to its level (mean density) and to what the maker allows: symmetry, ratio of neighbors,
/// limits of the cells.
///
/// The level stays what it was (or is the spec's) as far as the limits allow: what they hold, the other cells make up
/// for. A free level gives way by up to a fifth a step where the upper limit would hold cells down, because a lower
/// level needs a smaller range of densities; cells that a map holds below the common limit do not count there.
/// `current_mean`: mean density of the step before.
Proposal with_level(tracer::DensityField shape, double current_mean, const DesignSpec& spec);

}  // namespace evenglow::design
