#include "design/report/html_metrology.h"

#include <fmt/format.h>

#include "design/report/html_facts.h"
#include "design/report/html_figures.h"
#include "design/report/html_page.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

constexpr const char* kDeltaUv = "\u0394u\u2032v\u2032";

std::string range_text(const core::CellField& field) {
  const FieldSummary s = summarize(field);
  return rounded(s.min) + " \u2026 " + rounded(s.max);
}

std::string color_map_figure(const std::string& title, const core::CellField& field, const core::CellField* se,
                             PageData& data) {
  return map_figure({title, range_text(field), &field, se, "", "luminance", common_scale({&field})}, data);
}

/// Distance and error on one scale from zero: what is noise looks like it.
std::string delta_maps(const ColorJudgment& color, PageData& data) {
  const ValueScale scale{0.0, common_scale({&color.delta, &color.delta_se}).high};
  const auto figure = [&](const std::string& title, const core::CellField& field, const core::CellField* se) {
    return map_figure({title, range_text(field), &field, se, "", "luminance", scale}, data);
  };
  return joined({figure(fmt::format("{} from the mean color, noise included", kDeltaUv), color.delta, &color.delta_se),
                 figure(fmt::format("Standard error of {}", kDeltaUv), color.delta_se, nullptr)});
}

std::string pair_text(const core::Estimate& a, const core::Estimate& b) {
  return measured(a) + ", " + measured(b);
}

std::string exact_text(const core::Estimate& a, const core::Estimate& b) {
  return rounded(a.value, 5) + ", " + rounded(b.value, 5);
}

std::string cell(const std::string& text) {
  return "<td class=\"n\">" + html_escape(text) + "</td>";
}

std::string color_table(const ColorJudgment& color) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th></th><th class=\"n\">display</th><th class=\"n\">sources</th>"
      "</tr></thead>\n<tbody>\n";
  const auto add = [&](const std::string& name, const std::string& display, const std::string& emitted) {
    html += "<tr><td>" + html_escape(name) + "</td>" + cell(display) + cell(emitted) + "</tr>\n";
  };
  const ColorPoint& m = color.mean;
  const ColorPoint& e = color.emitted;
  add("x, y (CIE 1931)", pair_text(m.x, m.y), exact_text(e.x, e.y));
  add("u\u2032, v\u2032 (CIE 1976)", pair_text(m.u, m.v), exact_text(e.u, e.v));
  add("correlated color temperature (K)", measured(m.kelvin), measured(e.kelvin));
  add("distance from the Planckian locus, Duv", measured(m.distance), measured(e.distance));
  return html + "</tbody></table></div>\n";
}

std::string delta_table(const ColorJudgment& color) {
  const std::string unit = kDeltaUv;
  std::vector<std::pair<std::string, std::string>> facts{
      {"Cells from the mean color, RMS " + unit,
       measured(color.rms_corrected) + " with the Monte Carlo noise taken off (" + rounded(color.rms) + " with it)"},
      {"Greatest " + unit,
       measured(color.max_corrected) +
           (color.max_corrected.value < 0.0 ? " (negative: noise explains more than is seen)" : "") +
           ", found in one half of the batches and measured in the other (" + measured(color.max) +
           " in the map, at x " + rounded(color.max_x) + " mm, y " + rounded(color.max_y) + " mm)"},
      {"Display from sources, " + unit, measured(color.shift)}};
  if (color.dark_cells > 0) facts.emplace_back("Cells without light, left out", std::to_string(color.dark_cells));
  return fact_table(facts);
}

struct AngleRow {
  const char* name;
  std::optional<HalfAngles> AngularLuminance::*plane;
};
constexpr AngleRow kPlanes[] = {{"horizontal, in the plane of x", &AngularLuminance::horizontal},
                                {"vertical, in the plane of y", &AngularLuminance::vertical}};

std::string angle_text(const std::optional<HalfAngles>& angles) {
  if (!angles) return "no such angle";
  return measured(angles->from_deg) + " \u2026 " + measured(angles->to_deg) + "; width " + measured(angles->width_deg);
}

std::string spot_rows(const Report& report) {
  std::string html;
  for (const SpotLuminance& spot : report.angular_spots) {
    for (const AngleRow& row : kPlanes) {
      html += "<tr><td>" +
              html_escape(fmt::format("spot at x {} mm, y {} mm: {}", rounded(spot.x), rounded(spot.y), row.name)) +
              "</td>" + cell(angle_text(spot.angular.*row.plane)) + "</tr>\n";
    }
  }
  return html;
}

std::string mixing_text(const HotSpots& row) {
  const HotSpotLine& first = row.lines.front();
  const std::string start = measured(first.ratio) + " at " + rounded(first.distance) + " mm from the edge; ";
  if (!row.mixing_distance) return start + "the LEDs show at every distance";
  return start + "beyond " + rounded(*row.mixing_distance) + " mm within 2 % (and two standard errors) of 1";
}

}  // namespace

std::string color_section(const Report& report, PageData& data) {
  if (!report.color) return "";
  const ColorJudgment& color = *report.color;
  const std::string definition =
      "<p class=\"def\">Of the light within the viewing cone; sources: of the light as it is emitted. "
      "Distances are Euclidean in CIE 1976 (u\u2032, v\u2032).</p>\n";
  return joined({"<h2>Color</h2>\n", definition, color_table(color), delta_table(color),
                 figure_group("two", delta_maps(color, data), ""),
                 figure_group("two",
                              joined({color_map_figure("u\u2032", color.u, &color.u_se, data),
                                      color_map_figure("v\u2032", color.v, &color.v_se, data)}),
                              "")});
}

std::string half_angle_table(const std::vector<const Report*>& reports) {
  std::string head, body;
  for (const Report* report : reports) {
    if (report->angular) head += "<th class=\"n\">" + html_escape(report->variant) + "</th>";
  }
  if (head.empty()) return "";
  for (const AngleRow& row : kPlanes) {
    body += std::string("<tr><td>") + row.name + "</td>";
    for (const Report* report : reports) {
      if (report->angular) body += cell(angle_text((*report->angular).*row.plane));
    }
    body += "</tr>\n";
  }
  if (reports.size() == 1) body += spot_rows(*reports.front());
  return "<div class=\"scroll\"><table>\n<thead><tr><th>Half of the greatest luminance at (\u00b0)</th>" + head +
         "</tr></thead>\n<tbody>\n" + body + "</tbody></table></div>\n";
}

CurvePlot hot_spot_plot(const std::vector<HotSpots>& rows) {
  CurvePlot plot{
      "LEDs that show", "distance from the edge (mm)", "in front of LEDs over between them", false, false, false, {}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Curve curve;
    curve.name = fmt::format("sources[{}], {}", rows[i].source, rows[i].edge);
    curve.ink = series_ink(i);
    curve.marked = false;
    for (const HotSpotLine& line : rows[i].lines) {
      curve.x.push_back(line.distance);
      curve.y.push_back(line.ratio.value);
      curve.se.push_back(line.ratio.se);
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

std::string hot_spot_section(const Report& report, PageData& data) {
  std::vector<std::pair<std::string, std::string>> facts;
  for (const HotSpots& row : report.hot_spots) {
    if (row.lines.empty()) continue;
    facts.emplace_back(fmt::format("sources[{}], edge {}", row.source, row.edge), mixing_text(row));
  }
  if (facts.empty()) return "";
  return joined(
      {"<h2>Hot spots</h2>\n",
       "<p class=\"def\">Luminance in front of the LEDs of a row over that between them, by distance from "
       "their edge.</p>\n",
       fact_table(facts),
       figure_group("two", curve_figure(hot_spot_plot(report.hot_spots), "band: one standard error", data), "")});
}

}  // namespace evenglow::design
