#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Brings a proposed density to its level (mean density) and to what the maker allows: symmetry, ratio of neighbors,
/// limits of the cells.
///
/// The level stays what it was (or is the spec's) unless the upper limit would hold cells down: then it gives way by up
/// to a fifth a step, because a lower level needs a smaller range of densities. `current_mean`: mean density of the
/// step before.
Proposal with_level(tracer::DensityField shape, double current_mean, const DesignSpec& spec);

}  // namespace evenglow::design
