#pragma once

#include <utility>

#include "core/config/config_node.h"

namespace evenglow::tracer {

/// The key `cells`: numbers of cells along x and y, at most 1,000,000 in all. Faults are noted at the node, then the
/// fallback is given.
std::pair<int, int> read_cells(const core::ConfigNode& node, std::pair<int, int> fallback);

}  // namespace evenglow::tracer
