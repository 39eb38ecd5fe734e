#include "tracer/optics/material.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

struct OnePoleMaterial {
  const char* name;
  double strength;  // n^2 - 1 = strength l^2 / (l^2 - pole)
  double pole;      // um^2
  double loss_per_m;
};

constexpr OnePoleMaterial kMaterials[] = {
    {"pmma", 1.1819, 0.011313, 0.03},
    {"polycarbonate", 1.4182, 0.021304, 0.3},
};

}  // namespace

const std::vector<std::string>& material_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& m : kMaterials) result.emplace_back(m.name);
    return result;
  }();
  return names;
}

Material material(std::string_view name, double wavelength) {
  for (const auto& m : kMaterials) {
    if (name != m.name) continue;
    const double l2 = wavelength * wavelength * 1e-6;
    return {std::sqrt(1.0 + m.strength * l2 / (l2 - m.pole)), m.loss_per_m / core::kMmPerM};
  }
  throw core::Error("unknown material " + std::string(name));
}

}  // namespace evenglow::tracer
