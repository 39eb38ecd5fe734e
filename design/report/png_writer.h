#pragma once

#include "design/report/report.h"

namespace evenglow::design {

/// Pictures for slides, on white. Of a single run: luminance.png and density.png (pseudo-color maps with color bar,
/// axes in mm and true proportions), delta_uv.png where color was asked for, and convergence.png (RMS on a logarithmic
/// axis above, efficiency below, error bars of one standard error). Of a comparison: compare.png, luminance and density
/// of all variants, each on one color scale.
class PngWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

}  // namespace evenglow::design
