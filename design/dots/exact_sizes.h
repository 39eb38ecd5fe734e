#pragma once

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"

namespace evenglow::design {

/// Rounds the diameters to whole size steps such that the area under the dots of each cell comes within one dot of what
/// it must hold, as far as the limits allow: all dots of a cell are scaled alike, a fifth of the area at a time
/// (`full`: to the wanted area; else only as far as one dot's tolerance asks), then rounded one after another, each
/// taking over what rounding the ones before it left.
void fit_sizes(const DotSpec& spec, const CoverageMap& map, double least, double greatest, bool full, int threads,
               DotStore& store);

}  // namespace evenglow::design
