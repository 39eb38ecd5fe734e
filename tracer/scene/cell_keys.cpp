#include "tracer/scene/cell_keys.h"

#include <fmt/core.h>

namespace evenglow::tracer {

using core::ConfigNode;
using core::Range;

std::pair<int, int> read_cells(const ConfigNode& node, std::pair<int, int> fallback) {
  const auto cells = node.numbers({"cells",
                                   "number of cells along x and along y",
                                   Range::closed(1, 4096),
                                   2,
                                   2,
                                   {{static_cast<double>(fallback.first), static_cast<double>(fallback.second)}},
                                   true});
  if (cells.size() != 2) return fallback;
  if (cells[0] * cells[1] > 1e6) {
    node.fault_at("cells", fmt::format("must not be more than 1000000 cells in all, got {}", cells[0] * cells[1]));
    return fallback;
  }
  return {static_cast<int>(cells[0]), static_cast<int>(cells[1])};
}

}  // namespace evenglow::tracer
