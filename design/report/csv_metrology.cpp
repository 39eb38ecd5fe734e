#include "design/report/csv_metrology.h"

#include <initializer_list>

#include <fmt/format.h>

#include "design/report/csv_writer.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"

namespace evenglow::design {
namespace {

std::string row(std::string first, std::initializer_list<double> values) {
  for (const double value : values) first += ',' + shortest(value);
  return first + '\n';
}

void write_color(const ColorJudgment& color, const std::filesystem::path& directory) {
  const auto write = [&](const core::CellField& field, const std::string& quantity, const char* name) {
    write_file(directory / name, matrix_csv(field, quantity));
  };
  write(color.u, "u' (CIE 1976)", "color_u.csv");
  write(color.u_se, "standard error of u'", "color_u_se.csv");
  write(color.v, "v' (CIE 1976)", "color_v.csv");
  write(color.v_se, "standard error of v'", "color_v_se.csv");
  write(color.delta, "delta u'v' from the mean color of the active area", "delta_uv.csv");
  write(color.delta_se, "standard error of delta u'v'", "delta_uv_se.csv");
}

}  // namespace

std::string hot_spots_csv(const std::vector<HotSpots>& rows) {
  std::string text =
      "# luminance in front of the LEDs of a row and between them, by distance from their edge\n"
      "source,edge,distance_mm,front_cd_m2,front_se_cd_m2,between_cd_m2,between_se_cd_m2,ratio,ratio_se\n";
  for (const HotSpots& leds : rows) {
    for (const HotSpotLine& line : leds.lines) {
      text += row(fmt::format("{},{}", leds.source, leds.edge),
                  {line.distance, line.front.value, line.front.se, line.between.value, line.between.se,
                   line.ratio.value, line.ratio.se});
    }
  }
  return text;
}

std::string angular_spots_csv(const std::vector<SpotLuminance>& spots) {
  std::string text =
      "# luminance of spots (cd/m2) by direction of view: angles in degrees, polar from the normal, azimuth from x "
      "towards y\n"
      "spot,x_mm,y_mm,polar_min_deg,polar_max_deg,azimuth_min_deg,azimuth_max_deg,luminance_cd_m2,"
      "luminance_se_cd_m2\n";
  for (std::size_t s = 0; s < spots.size(); ++s) {
    const AngularLuminance& angular = spots[s].angular;
    const double width = 360.0 / angular.azimuth_count;
    for (std::size_t i = 0; i < angular.luminance.size(); ++i) {
      const std::size_t polar = i / static_cast<std::size_t>(angular.azimuth_count);
      const auto azimuth = static_cast<double>(i % static_cast<std::size_t>(angular.azimuth_count));
      text += row(std::to_string(s + 1),
                  {spots[s].x, spots[s].y, angular.polar_deg[polar], angular.polar_deg[polar + 1], azimuth * width,
                   (azimuth + 1.0) * width, angular.luminance[i].value, angular.luminance[i].se});
    }
  }
  return text;
}

void write_metrology(const Report& report, const std::filesystem::path& directory) {
  if (report.color) write_color(*report.color, directory);
  if (!report.hot_spots.empty()) write_file(directory / "hot_spots.csv", hot_spots_csv(report.hot_spots));
  if (!report.angular_spots.empty()) {
    write_file(directory / "angular_spots.csv", angular_spots_csv(report.angular_spots));
  }
}

}  // namespace evenglow::design
