#include "app/dots_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/dots_raster.h"
#include "core/math/cell_index.h"
#include "design/report/cairo_drawing.h"
#include "design/report/curve_plot.h"
#include "design/report/map_plot.h"

namespace evenglow::app {
namespace {

using design::CairoDrawing;
using design::MapPlot;

constexpr double kText = 22.0;
constexpr double kBarRoom = 8.0 * kText;

void write_whole_plate(const DotsReport& report, const std::filesystem::path& path) {
  const core::CellField share = coarse_raster(report.placement.dots, report.input.plate, 1300);
  const double most = *std::max_element(share.values.begin(), share.values.end());
  const MapPlot map{
      "Dots: " + report.input.title,
      fmt::format("{} dots; share of each pixel of {:.3g} mm under dots", report.placement.dots.size(), share.grid.dx),
      &share,
      {0.0, std::clamp(most, 0.01, 1.0)},
      &design::ColorMap::density(),
      kBarRoom - kText};
  const design::PlotSize size = design::map_size(share, {1600.0, 1500.0}, kText);
  const double width = std::max(size.width, 700.0), height = std::max(size.height, 13.0 * kText);
  CairoDrawing drawing(static_cast<int>(width + kBarRoom), static_cast<int>(height));
  const design::Box area = design::draw_map(drawing, map, {0, 0.2 * kText, width, size.height}, kText);
  design::draw_color_bar(drawing, *map.colors, map.scale, "share",
                         {area.right() + 1.5 * kText, area.top, 30.0, std::max(area.height, 5.0 * kText)}, kText);
  drawing.save(path);
}

void write_zoom(const DotsReport& report, const std::filesystem::path& path) {
  constexpr int kPixels = 560;
  constexpr double kPanel = kPixels + 6.0 * kText;
  const char* names[] = {"few dots", "middling", "many dots"};
  const auto squares = telling_squares(report.placement.dots, report.input.plate);
  CairoDrawing drawing(static_cast<int>(3 * kPanel), static_cast<int>(kPixels + 7.5 * kText));
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const core::CellField share = fine_raster(report.placement.dots, report.input.spec.footprint, squares[i], kPixels);
    const MapPlot map{
        names[i],
        fmt::format("{:.3g} mm square, {:.1f} % under dots", squares[i].x1 - squares[i].x0, 100.0 * share.mean()),
        &share,
        {0.0, 1.0},
        &design::ColorMap::density(),
        0.0};
    design::draw_map(drawing, map, {kPanel * static_cast<double>(i), 0.2 * kText, kPanel, kPixels + 7.0 * kText},
                     kText);
  }
  drawing.save(path);
}

design::CurvePlot radial_plot(const design::PowerSpectrum& spectrum) {
  design::CurvePlot plot;
  plot.title = "Radial mean";
  plot.x_label = "frequency (1 / mean spacing of the dots)";
  plot.y_label = "power (1: dots by chance)";
  plot.from_zero = true;
  design::Curve curve, chance;
  curve.marked = chance.marked = false;
  chance.dashed = true;
  chance.ink = design::Ink::muted;
  curve.name = "this pattern";
  chance.name = "by chance";
  for (std::size_t i = 0; i < spectrum.radial.size(); ++i) {
    curve.x.push_back((static_cast<double>(i) + 0.5) * spectrum.kBin);
    curve.y.push_back(spectrum.radial[i]);
  }
  chance.x = {0.0, 3.0};
  chance.y = {1.0, 1.0};
  plot.curves = {curve, chance};
  return plot;
}

void write_spectrum(const DotsReport& report, const std::filesystem::path& path) {
  constexpr double kHeight = 720.0, kMap = 760.0;
  const design::PowerSpectrum& spectrum = report.quality.spectrum;
  const int side = 2 * spectrum.kHalf + 1;
  core::CellField decibel(core::CellGrid::over(side, side, -3.025, -3.025, 3.025, 3.025), 0.0);
  for (std::size_t i = 0; i < decibel.values.size(); ++i)
    decibel.values[i] = 10.0 * std::log10(std::max(spectrum.map[i], 1e-3));
  CairoDrawing drawing(1700, static_cast<int>(kHeight));
  const design::TextStyle head{1.1 * kText, design::Align::left, design::Ink::text, true, false};
  drawing.text({20, 34}, design::fitted(drawing, "Power spectrum: " + report.input.title, head, 1660), head);
  const design::Box box{20, 80, kMap - 180, kMap - 180};
  std::vector<design::Rgb> colors;
  for (int row = side - 1; row >= 0; --row) {
    for (int column = 0; column < side; ++column) {
      const double value = decibel.values[core::cell_index(side, column, row)];
      colors.push_back(design::ColorMap::luminance().at((value + 20.0) / 30.0));
    }
  }
  drawing.cells(box, side, side, colors);
  drawing.text({box.left, box.bottom() + 1.6 * kText}, "fx, fy from -3 to 3 / mean spacing",
               {kText, design::Align::left, design::Ink::muted, false, false});
  design::draw_color_bar(drawing, design::ColorMap::luminance(), {-20.0, 10.0}, "dB",
                         {box.right() + kText, box.top, 28.0, box.height}, kText);
  design::draw_curves(drawing, radial_plot(spectrum), {kMap, 70, 920, kHeight - 90}, kText, true);
  drawing.save(path);
}

}  // namespace

void write_dots_pictures(const DotsReport& report, const std::filesystem::path& directory) {
  write_whole_plate(report, directory / "dots.png");
  write_zoom(report, directory / "dots_zoom.png");
  if (report.quality.spectrum.windows > 0) write_spectrum(report, directory / "dots_spectrum.png");
}

}  // namespace evenglow::app
