#include "design/engine/level_color.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>

namespace evenglow::design {
namespace {

bool keeps(const core::Estimate& color, double bound) {
  return color.value <= bound + color.se;
}

/// Between the levels on both sides; the errors of the two are taken as one's.
core::Estimate color_at(const ColorData& data, double level) {
  std::size_t above = 1;
  while (above + 1 < data.levels.size() && data.levels[above] < level) ++above;
  const core::Estimate &a = data.colors[above - 1], &b = data.colors[above];
  const double from = std::log(data.levels[above - 1]), to = std::log(data.levels[above]);
  const double share = std::clamp((std::log(level) - from) / (to - from), 0.0, 1.0);
  return {(1.0 - share) * a.value + share * b.value, (1.0 - share) * a.se + share * b.se};
}

}  // namespace

ColorLevel level_for_color(const ColorData& data, double wanted) {
  ColorLevel result{wanted, true, " Color RMS in (u', v') at these levels"};
  for (const core::Estimate& color : data.colors)
    result.note += fmt::format(" {:.5f} +- {:.5f},", color.value, color.se);
  if (keeps(color_at(data, wanted), data.bound)) {
    result.note += fmt::format(" the bound of {:.5f} is kept.", data.bound);
    return result;
  }
  const auto away = [&](std::size_t i) { return std::abs(std::log(data.levels[i] / wanted)); };
  std::size_t nearest = data.levels.size(), least = data.levels.size();
  for (std::size_t i = 0; i < data.levels.size(); ++i) {
    if (data.levels[i] < data.least_level) continue;
    if (least == data.levels.size() || data.colors[i].value < data.colors[least].value) least = i;
    if (!keeps(data.colors[i], data.bound)) continue;
    if (nearest == data.levels.size() || away(i) < away(nearest)) nearest = i;
  }
  result.kept = nearest < data.levels.size();
  if (!result.kept && least == data.levels.size()) {
    result.note += fmt::format(" the bound of {:.5f} cannot be kept by the level.", data.bound);
    return result;
  }
  result.level = data.levels[result.kept ? nearest : least];
  result.note +=
      result.kept ? fmt::format(" which breaks the bound of {:.5f} there: {:.4f} is taken, the nearest that keeps it.",
                                data.bound, result.level)
                  : fmt::format(" no level keeps the bound of {:.5f}: {:.4f} is taken, the least RMS.", data.bound,
                                result.level);
  return result;
}

}  // namespace evenglow::design
