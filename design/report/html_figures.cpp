#include "design/report/html_figures.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/svg_drawing.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

std::string bar_element(double max_width) {
  return fmt::format("<div class=\"bar\" style=\"max-width:{:.0f}px\"><span></span><i></i><span></span></div>",
                     max_width);
}

std::string caption_element(const std::string& title, const std::string& caption) {
  return fmt::format("<figcaption>{}{}</figcaption>\n", html_escape(title),
                     caption.empty() ? "" : "<small>" + html_escape(caption) + "</small>");
}

std::string ticks_element(double start, double length, int wanted, bool along_x) {
  std::string spans;
  for (const Tick& tick : linear_axis({start, start + length}, wanted).ticks) {
    spans += fmt::format("<span style=\"{}:{:.2f}%\">{}</span>", along_x ? "left" : "bottom",
                         100.0 * (tick.value - start) / length, tick.label);
  }
  return fmt::format("<div class=\"ticks {}\">{}<span class=\"axis\">{} (mm)</span></div>\n", along_x ? "tx" : "ty",
                     spans, along_x ? "x" : "y");
}

std::string key_element(const Curve& curve) {
  const char* kind = curve.dashed ? " dash" : (curve.joined ? "" : " dot");
  return fmt::format("<span class=\"i-{}{}\"><i></i>{}</span>\n", ink_class(curve.ink), kind, html_escape(curve.name));
}

}  // namespace

std::string map_figure(const MapFigure& map, PageData& data) {
  if (!is_filled(*map.field)) return "<figure>" + caption_element(map.title, "no values") + "</figure>\n";
  const core::CellGrid& grid = map.field->grid;
  const double width = grid.nx * grid.dx;
  const double height = grid.ny * grid.dy;
  std::string html = fmt::format("<figure class=\"map\" data-map=\"{}\">\n",
                                 data.add_map(*map.field, map.se,
                                              {map.title, map.quantity.empty() ? map.colors : map.quantity, map.unit,
                                               map.colors, map.scale, map.series}));
  html += caption_element(map.title, map.caption);
  // A high panel must not push the page apart: its width is what makes it 460 px high.
  const double max_width = std::max(60.0, 460.0 * width / height);
  html += fmt::format("<div class=\"field\" style=\"max-width:{:.0f}px\">\n", max_width);
  html += fmt::format(
      "<canvas tabindex=\"0\" style=\"aspect-ratio:{:.4f}\" role=\"img\" aria-label=\"{}\"><!-- drawn by the script "
      "below "
      "--></canvas>\n",
      width / height, html_escape(map.title + ", " + map.caption));
  html += ticks_element(grid.x0, width, width < 0.6 * height ? 2 : 5, true);
  html += ticks_element(grid.y0, height, height < 0.25 * width ? 1 : (height < 0.8 * width ? 3 : 5), false);
  return html + "</div>\n" + bar_element(std::max(240.0, max_width)) +
         "\n<output class=\"read\">Point at the map to read values.</output>\n</figure>\n";
}

std::string curve_figure(const CurvePlot& plot, const std::string& note, PageData& data) {
  constexpr double width = 420.0;
  constexpr double height = 256.0;
  SvgDrawing drawing(width, height);
  CurvePlot body = plot;
  body.title.clear();  // stands in the caption
  const PlotFrame frame = draw_curves(drawing, body, {2, 0, width - 2, height - 2}, 12.0, false);
  std::string keys;
  for (const Curve& curve : plot.curves) {
    if (curve.in_legend) keys += key_element(curve);
  }
  return fmt::format(
      "<figure class=\"curves\" data-curves=\"{}\">\n{}{}<div class=\"keys\">\n{}</div>\n"
      "<output class=\"read\">Point at the curves to read values.</output>\n</figure>\n",
      data.add_curves(plot, frame, width), caption_element(plot.title, note),
      drawing.element(plot.title + ": " + plot.y_label + " against " + plot.x_label), keys);
}

std::string polar_figure(const std::string& title, const AngularLuminance& angular, double top, PageData& data) {
  return fmt::format(
      "<figure class=\"polar\" data-polar=\"{}\">\n{}<canvas style=\"aspect-ratio:1\" role=\"img\" "
      "aria-label=\"{}\"></canvas>\n"
      "{}\n<output class=\"read\">Point at the disc to read values.</output>\n</figure>\n",
      data.add_polar(angular, "cd/m\u00b2", top),
      caption_element(title, "normal view in the center, grazing at the rim; x to the right"), html_escape(title),
      bar_element(320.0));
}

std::string figure_group(const std::string& layout, const std::string& figures, const std::string& id) {
  if (id.empty()) return fmt::format("<div class=\"{}\">\n{}</div>\n", layout, figures);
  const std::string name = html_escape(id);
  return fmt::format(
      "<div class=\"tools\"><button type=\"button\" data-scales=\"{0}\"></button>\n"
      "<button type=\"button\" data-palette></button></div>\n"
      "<div class=\"{1}\" id=\"{0}\">\n{2}</div>\n"
      "<div class=\"cut\" data-cut=\"{0}\"></div>\n",
      name, layout, figures);
}

}  // namespace evenglow::design
