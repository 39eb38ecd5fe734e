#include "design/report/csv_writer.h"

#include <initializer_list>

#include <fmt/format.h>

#include "design/report/csv_metrology.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

std::string row(std::string first, std::initializer_list<double> values) {
  for (const double value : values) first += ',' + shortest(value);
  return first + '\n';
}

void write_matrix(const core::CellField& field, const std::string& quantity, const std::filesystem::path& path) {
  if (is_filled(field)) write_file(path, matrix_csv(field, quantity));
}

}  // namespace

std::string convergence_csv(const Report& report) {
  std::string text =
      "step,photons,rms,rms_corrected,rms_corrected_se,efficiency,efficiency_se,mean_density,luminance_mean_cd_m2,"
      "cpu_s,wall_s,noise,held_low,held_high,level_photons,updater\n";
  for (const StepRecord& s : report.steps) {
    text += row(fmt::format("{},{}", s.step, s.photons),
                {s.rms, s.rms_corrected.value, s.rms_corrected.se, s.efficiency.value, s.efficiency.se, s.mean_density,
                 s.luminance_mean, s.cpu_s, s.wall_s, s.noise, static_cast<double>(s.held_low),
                 static_cast<double>(s.held_high), static_cast<double>(s.level_photons)});
    text.back() = ',';
    text += csv_field(s.updater) + '\n';
  }
  return text;
}

std::string matrix_csv(const core::CellField& field, const std::string& quantity) {
  const core::CellGrid& g = field.grid;
  std::string text =
      fmt::format("# {}; {} rows = y, {} columns = x; cell {} mm x {} mm; first corner at x {} mm, y {} mm\n", quantity,
                  g.ny, g.nx, g.dx, g.dy, g.x0, g.y0);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const bool last = (i + 1) % static_cast<std::size_t>(g.nx) == 0;
    text += shortest(field.values[i]) + (last ? '\n' : ',');
  }
  return text;
}

std::string angular_csv(const AngularLuminance& angular) {
  std::string text =
      "# luminance averaged over the active area (cd/m2) by direction of view: angles in degrees, polar from the "
      "normal, azimuth from x towards y\n"
      "polar_min_deg,polar_max_deg,azimuth_min_deg,azimuth_max_deg,luminance_cd_m2,luminance_se_cd_m2\n";
  const auto azimuths = static_cast<std::size_t>(angular.azimuth_count);
  for (std::size_t i = 0; i < angular.luminance.size(); ++i) {
    const std::size_t polar = i / azimuths;
    const double width = 360.0 / angular.azimuth_count;
    const auto azimuth = static_cast<double>(i % azimuths);
    text +=
        row(shortest(angular.polar_deg[polar]), {angular.polar_deg[polar + 1], azimuth * width, (azimuth + 1.0) * width,
                                                 angular.luminance[i].value, angular.luminance[i].se});
  }
  return text;
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "variant,emitted_lm,luminance_mean_cd_m2,luminance_mean_se,rms_corrected,rms_corrected_se,uniformity_9,"
      "uniformity_13,efficiency,efficiency_se,ratio_luminance,ratio_luminance_se,ratio_flux,ratio_flux_se,"
      "ratio_efficiency,ratio_efficiency_se\n";
  const VariantRatio to_itself{"", {1, 0}, {1, 0}, {1, 0}};
  for (std::size_t i = 0; i < comparison.variants.size(); ++i) {
    const Report& report = comparison.variants[i];
    const FinalJudgment& f = report.final;
    const VariantRatio& r = i == 0 ? to_itself : comparison.ratios.at(i - 1);
    text += row(csv_field(report.variant),
                {report.energy.emitted_lm, f.luminance_mean.value, f.luminance_mean.se, f.rms_corrected.value,
                 f.rms_corrected.se, f.uniformity_9, f.uniformity_13, f.efficiency.value, f.efficiency.se,
                 r.luminance.value, r.luminance.se, r.flux.value, r.flux.se, r.efficiency.value, r.efficiency.se});
  }
  return text;
}

void CsvWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_file(directory / "convergence.csv", convergence_csv(report));
  write_matrix(report.luminance, "luminance (cd/m2)", directory / "luminance.csv");
  write_matrix(report.luminance_se, "standard error of the luminance (cd/m2)", directory / "luminance_se.csv");
  write_matrix(report.density, "density of the microstructure (share of the cell's area, 1)",
               directory / "density.csv");
  if (report.dots) {
    write_matrix(report.dots->luminance, "luminance of the dots (cd/m2)", directory / "dots_luminance.csv");
    write_matrix(report.dots->luminance_se, "standard error of the luminance of the dots (cd/m2)",
                 directory / "dots_luminance_se.csv");
    write_matrix(report.dots->density, "density that the dots were placed for (share of the cell's area, 1)",
                 directory / "dots_density.csv");
  }
  if (report.angular) write_file(directory / "angular.csv", angular_csv(*report.angular));
  write_metrology(report, directory);
}

void CsvWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  write_file(directory / "compare.csv", comparison_csv(comparison));
}

}  // namespace evenglow::design
