#include "design/report/png_writer.h"

#include <algorithm>
#include <cmath>

#include "design/report/cairo_drawing.h"
#include "design/report/map_plot.h"
#include "design/report/number_format.h"
#include "design/report/report_curves.h"

namespace evenglow::design {
namespace {

constexpr double text_size = 26.0;            ///< px
constexpr double bar_width = 36.0;            ///< px, of a color bar
constexpr double bar_room = 8.0 * text_size;  ///< px, with its ticks and unit
constexpr const char* luminance_unit = "cd/m\u00b2";

int pixels(double length) {
  return static_cast<int>(std::ceil(length));
}

std::string range_text(const core::CellField& field) {
  const FieldSummary summary = summarize(field);
  return rounded(summary.min) + " \u2026 " + rounded(summary.max);
}

std::string luminance_caption(const Report& report) {
  return "mean " + measured(report.final.luminance_mean) + " " + luminance_unit + ", " + range_text(report.luminance);
}

std::string density_caption(const Report& report) {
  return "mean " + rounded(summarize(report.density).mean) + ", " + range_text(report.density);
}

std::string delta_uv_caption(const ColorJudgment& color) {
  return "from the mean color; RMS " + measured(color.rms_corrected) + " (noise taken off); standard error of a cell " +
         rounded(summarize(color.delta_se).mean, 2);
}

std::string titled(const Report& report, const std::string& quantity) {
  std::string title = report.title;
  if (!report.variant.empty()) title += title.empty() ? report.variant : ", " + report.variant;
  return title.empty() ? quantity : quantity + ": " + title;
}

/// A bar as high as the map beside it, if that is high enough for ticks.
Box bar_beside(const Box& area, double right) {
  return {right + 1.5 * text_size, area.top, bar_width, std::max(area.height, 5.0 * text_size)};
}

void write_map(MapPlot map, const std::string& unit, const std::filesystem::path& path) {
  const PlotSize size = map_size(*map.field, {1600.0 - bar_room, 1200.0}, text_size);
  // A tall map is narrower than what is to be read above it.
  const double caption = std::ceil(caption_right(CairoDrawing(1, 1), map, text_size)) + text_size - bar_room;
  const double map_width = std::max({size.width, 900.0 - bar_room, std::min(caption, 1600.0 - bar_room)});
  CairoDrawing drawing(pixels(map_width + bar_room), pixels(std::max(size.height, 13.0 * text_size)));
  map.text_room = bar_room - text_size;
  const Box area = draw_map(drawing, map, {0, 0.2 * text_size, map_width, size.height}, text_size);
  if (is_filled(*map.field)) {
    draw_color_bar(drawing, *map.colors, map.scale, unit, bar_beside(area, area.right()), text_size);
  }
  drawing.save(path);
}

void write_convergence(const Report& report, const std::filesystem::path& path) {
  CairoDrawing drawing(1600, 1200);
  const TextStyle heading{1.15 * text_size, Align::left, Ink::text, true, false};
  drawing.text({40, 52}, fitted(drawing, titled(report, "Convergence"), heading, 1520), heading);
  draw_curves(drawing, rms_plot({&report}), {40, 80, 1520, 600}, text_size, true);
  draw_curves(drawing, efficiency_plot({&report}), {40, 690, 1520, 490}, text_size, true);
  drawing.save(path);
}

/// Maps of all variants in rows of up to three, one color bar.
class MapTable {
 public:
  MapTable(std::vector<MapPlot> maps, std::string unit) : maps_(std::move(maps)), unit_(std::move(unit)) {
    for (const MapPlot& map : maps_) {
      const PlotSize size = map_size(*map.field, {760.0, 760.0}, text_size);
      cell_.width = std::max({cell_.width, size.width, 520.0});
      cell_.height = std::max({cell_.height, size.height, 13.0 * text_size});
    }
  }

  double width() const { return static_cast<double>(columns()) * cell_.width + bar_room; }
  double height() const {
    const std::size_t rows = (maps_.size() + columns() - 1) / columns();
    return static_cast<double>(rows) * cell_.height;
  }

  void draw(CairoDrawing& drawing, double top) const {
    Box first;
    for (std::size_t i = 0; i < maps_.size(); ++i) {
      const std::size_t column = i % columns(), row = i / columns();
      const Box box{static_cast<double>(column) * cell_.width, top + static_cast<double>(row) * cell_.height,
                    cell_.width, cell_.height};
      const Box area = draw_map(drawing, maps_[i], box, text_size);
      if (i == 0) first = area;
    }
    const double right = static_cast<double>(columns()) * cell_.width;
    draw_color_bar(drawing, *maps_[0].colors, maps_[0].scale, unit_, bar_beside(first, right - text_size), text_size);
  }

 private:
  std::size_t columns() const { return std::min<std::size_t>(maps_.size(), maps_.size() == 4 ? 2 : 3); }

  std::vector<MapPlot> maps_;
  std::string unit_;
  PlotSize cell_;
};

MapTable luminance_table(const std::vector<Report>& variants) {
  std::vector<const core::CellField*> fields;
  fields.reserve(variants.size());
  for (const Report& report : variants) fields.push_back(&report.luminance);
  std::vector<MapPlot> maps;
  maps.reserve(variants.size());
  for (const Report& report : variants) {
    const std::string caption =
        measured(report.final.luminance_mean) + " " + luminance_unit + ", RMS " + percent(report.final.rms_corrected);
    maps.push_back(
        {"Luminance: " + report.variant, caption, &report.luminance, common_scale(fields), &ColorMap::luminance()});
  }
  return {std::move(maps), luminance_unit};
}

MapTable density_table(const std::vector<Report>& variants) {
  std::vector<const core::CellField*> fields;
  fields.reserve(variants.size());
  for (const Report& report : variants) fields.push_back(&report.density);
  std::vector<MapPlot> maps;
  maps.reserve(variants.size());
  for (const Report& report : variants) {
    maps.push_back({"Density: " + report.variant, density_caption(report), &report.density, common_scale(fields),
                    &ColorMap::density()});
  }
  return {std::move(maps), "density"};
}

}  // namespace

void PngWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_map({titled(report, "Luminance"), luminance_caption(report), &report.luminance,
             common_scale({&report.luminance}), &ColorMap::luminance()},
            luminance_unit, directory / "luminance.png");
  write_map({titled(report, "Density"), density_caption(report), &report.density, common_scale({&report.density}),
             &ColorMap::density()},
            "density", directory / "density.png");
  if (report.color) {
    write_map({titled(report, "\u0394u\u2032v\u2032"),
               delta_uv_caption(*report.color),
               &report.color->delta,
               {0.0, common_scale({&report.color->delta}).high},
               &ColorMap::luminance()},
              "\u0394u\u2032v\u2032", directory / "delta_uv.png");
  }
  write_convergence(report, directory / "convergence.png");
}

void PngWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  if (comparison.variants.empty()) return;
  const MapTable luminance = luminance_table(comparison.variants);
  const MapTable density = density_table(comparison.variants);
  const double heading_height = 3.0 * text_size;
  CairoDrawing drawing(pixels(std::max(luminance.width(), density.width())),
                       pixels(heading_height + luminance.height() + density.height() + text_size));
  const TextStyle heading{1.4 * text_size, Align::left, Ink::text, true, false};
  drawing.text({1.5 * text_size, 1.9 * text_size}, fitted(drawing, comparison.title, heading, luminance.width() - 80),
               heading);
  luminance.draw(drawing, heading_height);
  density.draw(drawing, heading_height + luminance.height() + 0.5 * text_size);
  drawing.save(directory / "compare.png");
}

}  // namespace evenglow::design
