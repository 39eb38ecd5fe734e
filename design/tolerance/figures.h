#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/montecarlo/estimate.h"
#include "design/problem/judgment.h"

namespace evenglow::design {

/// A figure of merit that a tolerance run follows from sample to sample.
struct Figure {
  const char* name;   ///< as in result.json
  const char* title;  ///< for people
  const char* unit;   ///< as shown, times `scale`
  double scale;
};

inline constexpr std::array<Figure, 6> kFigures{{
    {"rms_corrected", "RMS non-uniformity", "%", 100.0},
    {"uniformity_9", "uniformity of 9 spots", "%", 100.0},
    {"uniformity_13", "uniformity of 13 spots", "%", 100.0},
    {"luminance_mean_cd_m2", "mean luminance", "cd/m\u00b2", 1.0},
    {"luminance_centre_cd_m2", "luminance of the center", "cd/m\u00b2", 1.0},
    {"efficiency", "efficiency", "%", 100.0},
}};

/// The figures of a judgment, in the order of `kFigures`.
std::vector<core::Estimate> figures_of(const FinalJudgment& judged);

/// Its place in `kFigures`; -1: there is none.
int figure_index(std::string_view name);

}  // namespace evenglow::design
