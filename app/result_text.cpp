#include "app/result_text.h"

#include <cmath>
#include <string>

#include <fmt/core.h>

#include "core/config/message_text.h"
#include "design/report/number_format.h"

namespace evenglow::app {
namespace {

/// Spots without any light have no ratio, or one without an error.
std::string spot_ratio(double ratio, double error) {
  if (!std::isfinite(ratio)) return "-";
  return std::isfinite(error) ? fmt::format("{:.3f} +- {:.3f}", ratio, error) : fmt::format("{:.3f}", ratio);
}

}  // namespace

void print_result(const design::Report& report, const std::filesystem::path& directory) {
  const design::FinalJudgment& f = report.final;
  fmt::print("{}{}\n", core::one_line(report.title), report.variant.empty() ? "" : " (" + report.variant + ")");
  fmt::print("  stop                 {}\n", core::one_line(report.stop_reason));
  const std::string why_none = f.luminance_mean.value <= 0.0         ? "no light in the viewing cone"
                               : report.luminance.values.size() == 1 ? "at least two cells are needed"
                                                                     : "";
  if (!why_none.empty()) {
    fmt::print("  RMS non-uniformity   - ({})\n", why_none);
  } else {
    fmt::print("  RMS non-uniformity   {:.2f} +- {:.2f} % (noise taken off; {:.2f} % with it)\n",
               100.0 * f.rms_corrected.value, 100.0 * f.rms_corrected.se, 100.0 * f.rms);
  }
  for (const design::ViewJudgment& view : f.views) {
    fmt::print("  seen from {:>10}  RMS {:.2f} +- {:.2f} %, {:.1f} +- {:.1f} cd/m2 (weight {:.3g})\n",
               fmt::format("{:.3g}/{:.3g}", view.polar_deg, view.azimuth_deg), 100.0 * view.rms_corrected.value,
               100.0 * view.rms_corrected.se, view.luminance_mean.value, view.luminance_mean.se, view.share);
  }
  fmt::print("  mean luminance       {:.1f} +- {:.1f} cd/m2\n", f.luminance_mean.value, f.luminance_mean.se);
  fmt::print("  efficiency           {:.2f} +- {:.2f} %\n", 100.0 * f.efficiency.value, 100.0 * f.efficiency.se);
  if (!why_none.empty()) {
    fmt::print("  uniformity 9 / 13    - ({})\n", why_none);
  } else {
    fmt::print("  uniformity 9 / 13    {} / {}\n", spot_ratio(f.uniformity_9, f.uniformity_9_se),
               spot_ratio(f.uniformity_13, f.uniformity_13_se));
  }
  if (report.color) {
    fmt::print("  color                x {}, y {}, {} K\n", design::measured(report.color->mean.x),
               design::measured(report.color->mean.y), design::measured(report.color->mean.kelvin));
    fmt::print("  color RMS, maximum   {}, {} (delta u'v' from the mean, noise taken off)\n",
               design::measured(report.color->rms_corrected), design::measured(report.color->max_corrected));
  }
  if (report.dots) {
    const design::DotsJudgment& dots = *report.dots;
    fmt::print(
        "  as dots              {} dots: RMS {:.2f} +- {:.2f} %, mean luminance {:.4f} +- {:.4f} of that above\n",
        dots.rounds[dots.chosen].dots, 100.0 * dots.final.rms_corrected.value, 100.0 * dots.final.rms_corrected.se,
        dots.over_density.value, dots.over_density.se);
  }
  fmt::print("  photons, time        {:.3g} in the final trace, {:.1f} s in all\n", static_cast<double>(f.photons),
             report.timing.wall_s);
  fmt::print("  files                {}\n", core::one_line(directory.string()));
}

}  // namespace evenglow::app
