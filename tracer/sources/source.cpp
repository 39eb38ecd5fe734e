#include "tracer/sources/source.h"

namespace evenglow::tracer {

Side read_side(const core::ConfigNode& node, const core::ChoiceKey& key) {
  const std::string name = node.choice(key);
  for (int i = 0; i < kSides; ++i) {
    if (name == side_name(static_cast<Side>(i))) return static_cast<Side>(i);
  }
  return Side::kLeft;
}

SideAxes side_axes(Side side) {
  const core::Vec3 inward = -outward(side);
  switch (axis_of(side)) {
    case 0:
      return {core::Vec3::UnitY(), core::Vec3::UnitZ(), inward};
    case 1:
      return {core::Vec3::UnitX(), core::Vec3::UnitZ(), inward};
    default:
      return {core::Vec3::UnitX(), core::Vec3::UnitY(), inward};
  }
}

}  // namespace evenglow::tracer
