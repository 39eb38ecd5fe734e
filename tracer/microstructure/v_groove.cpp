#include "tracer/microstructure/v_groove.h"

#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "tracer/microstructure/bump_keys.h"

namespace evenglow::tracer {

using core::Vec3;

Ridge::Ridge(double left, double right, double fill) : half_(1.0 / fill) {
  const double tan_left = std::tan(left);
  const double tan_right = std::tan(right);
  height_ = 2.0 * tan_left * tan_right / (tan_left + tan_right);
  facets_.normals = {Vec3(-std::sin(left), 0, std::cos(left)), Vec3(std::sin(right), 0, std::cos(right))};
  facets_.offsets = {std::sin(left), std::sin(right)};
}

void Ridge::next_cell(Vec3& p, const Vec3& k) const {
  p.z() += way_to_wall(p, k) * k.z();
  p.x() = -std::copysign(half_, k.x());
}

Microstructure make_v_groove(const core::ConfigNode& node) {
  const BumpPlacement placement = read_placement(node, "direction of the groove, counted from +x towards +y", 90.0);
  auto flanks = node.numbers({"flanks_deg", "angles between flank and face, of the flank on either side",
                              core::Range::closed(0.1, kSteepest), 2, 2, std::vector<double>{45.0, 45.0}});
  if (flanks.size() != 2) flanks.assign(2, 45.0 * core::kRadPerDeg);
  const double fill = read_fill(node, 1.0);
  return bump_of("v_groove", Ridge(flanks[0], flanks[1], fill), placement, fill);
}

}  // namespace evenglow::tracer
