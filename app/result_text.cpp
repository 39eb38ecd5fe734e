#include "app/result_text.h"

#include <fmt/core.h>

#include "design/report/number_format.h"

namespace evenglow::app {

void print_result(const design::Report& report, const std::filesystem::path& directory) {
  const design::FinalJudgment& f = report.final;
  fmt::print("{}{}\n", report.title, report.variant.empty() ? "" : " (" + report.variant + ")");
  fmt::print("  stop                 {}\n", report.stop_reason);
  const bool dark = f.luminance_mean.value <= 0.0;
  if (dark) fmt::print("  RMS non-uniformity   - (no light in the viewing cone)\n");
  if (!dark) {
    fmt::print("  RMS non-uniformity   {:.2f} +- {:.2f} % (noise taken off; {:.2f} % with it)\n",
               100.0 * f.rms_corrected.value, 100.0 * f.rms_corrected.se, 100.0 * f.rms);
  }
  fmt::print("  mean luminance       {:.1f} +- {:.1f} cd/m2\n", f.luminance_mean.value, f.luminance_mean.se);
  fmt::print("  efficiency           {:.2f} +- {:.2f} %\n", 100.0 * f.efficiency.value, 100.0 * f.efficiency.se);
  if (dark) fmt::print("  uniformity 9 / 13    - (no light in the viewing cone)\n");
  if (!dark) {
    fmt::print("  uniformity 9 / 13    {:.3f} +- {:.3f} / {:.3f} +- {:.3f}\n", f.uniformity_9, f.uniformity_9_se,
               f.uniformity_13, f.uniformity_13_se);
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
  fmt::print("  files                {}\n", directory.string());
}

}  // namespace evenglow::app
