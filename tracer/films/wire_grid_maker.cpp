#include "tracer/films/wire_grid_maker.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "tracer/films/film_keys.h"
#include "tracer/films/wire_grid.h"

namespace evenglow::tracer {

Film make_wire_grid(const core::ConfigNode& node) {
  Film film = film_of("wire_grid", node);
  film.axis = axis_of(node, "pass axis (across the wires), counted from +x towards +y");
  film.axis_index = 1.0;
  WireGrid::Powers p;
  p.transmittance_pass = share(node, "transmittance_pass", "transmittance of light along the pass axis", 0.88);
  p.reflectance_pass =
      share(node, "reflectance_pass",
            "reflectance of light along the pass axis; default: 0.04, or what transmittance_pass leaves",
            std::min(0.04, 1.0 - p.transmittance_pass));
  require_sum(node, p.transmittance_pass, "transmittance_pass", p.reflectance_pass, "reflectance_pass");
  const double extinction = node.number({"extinction", "transmittance along the pass axis over that along the wires",
                                         core::Range::closed(1, 1e12), 1000.0});
  p.transmittance_block = p.transmittance_pass / extinction;
  p.reflectance_block = share(node, "reflectance_block",
                              "reflectance of light along the wires; default: 0.9, or what the transmittance leaves",
                              std::min(0.9, 1.0 - p.transmittance_block));
  if (p.transmittance_block + p.reflectance_block > 1.0 + 1e-12) {
    node.fault_at("reflectance_block",
                  fmt::format("must be at most 1 - transmittance_pass / extinction = {:g}, got {:g}",
                              1.0 - p.transmittance_block, p.reflectance_block));
    p.reflectance_block = 1.0 - p.transmittance_block;
  }
  film.surface = std::make_unique<WireGrid>(p, film.axis);
  return film;
}

}  // namespace evenglow::tracer
