#pragma once

#include <string>
#include <vector>

#include "core/montecarlo/estimate.h"

/// Evenness of the color against the level (mean density) of a shape.
namespace evenglow::design {

/// What was seen of the color at rising levels, and its bound.
struct ColorData {
  const std::vector<double>& levels;
  const std::vector<core::Estimate>& colors;  ///< RMS in (u', v') of each
  double bound = 0.0;
  double least_level = 0.0;  ///< lower ones are out of the question
};

/// The level that was chosen for the color.
struct ColorLevel {
  double level = 0.0;
  bool kept = true;
  std::string note;  ///< what was seen, one sentence that begins with a space
};

/// `wanted`, if the color there (linear in ln level between the levels that were seen) keeps its bound within a
/// standard error; else the nearest of the levels seen that keeps it; if none does, that of the least RMS.
ColorLevel level_for_color(const ColorData& data, double wanted);

}  // namespace evenglow::design
