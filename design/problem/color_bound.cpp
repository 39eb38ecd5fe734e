#include "design/problem/color_bound.h"

#include <cmath>

#include <fmt/core.h>

#include "design/problem/color_merit.h"

namespace evenglow::design {

std::optional<core::Estimate> color_rms(const Observation& observation) {
  if (observation.color_x.bins() == 0) return std::nullopt;
  const core::Vec3 any(1.0, 1.0, 1.0);  // the emitted light has no say in the differences of cells
  const ColorJudgment color = judge_color(observation.map.luminance.grid,
                                          {observation.color_x, observation.luminance, observation.color_z}, any);
  if (!std::isfinite(color.rms_corrected.value)) return std::nullopt;
  return color.rms_corrected;
}

bool keeps_color(const std::optional<core::Estimate>& color, const std::optional<double>& bound) {
  return !bound || !color || color->value <= *bound + color->se;
}

std::string color_verdict(const core::Estimate& color, double bound) {
  const std::string seen =
      fmt::format("Color: the independent trace shows an RMS of {:.5f} +- {:.5f} in (u', v')", color.value, color.se);
  if (color.value <= bound) return fmt::format("{}; the bound of {:.5f} is kept.", seen, bound);
  if (color.value <= bound + 2.0 * color.se)
    return fmt::format("{}: above the bound of {:.5f}, but within its error.", seen, bound);
  return fmt::format("{}: the bound of {:.5f} is NOT kept.", seen, bound);
}

}  // namespace evenglow::design
