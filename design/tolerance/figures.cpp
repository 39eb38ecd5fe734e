#include "design/tolerance/figures.h"

#include <algorithm>

namespace evenglow::design {

std::vector<core::Estimate> figures_of(const FinalJudgment& judged) {
  return {judged.rms_corrected,
          {judged.uniformity_9, judged.uniformity_9_se},
          {judged.uniformity_13, judged.uniformity_13_se},
          judged.luminance_mean,
          {judged.luminance_center, judged.luminance_center_se},
          judged.efficiency};
}

int figure_index(std::string_view name) {
  const auto found = std::find_if(kFigures.begin(), kFigures.end(), [&](const Figure& f) { return f.name == name; });
  return found == kFigures.end() ? -1 : static_cast<int>(found - kFigures.begin());
}

}  // namespace evenglow::design
