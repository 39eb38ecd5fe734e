#include "design/report/study.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/cairo_drawing.h"
#include "design/report/html_figures.h"
#include "design/report/html_page.h"
#include "design/report/page_data.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

std::string element(const char* tag, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", tag, html_escape(text));
}

std::string row_of(const char* cell, const std::vector<std::string>& entries) {
  std::string html = "<tr>";
  for (const std::string& entry : entries) html += fmt::format("<{0}>{1}</{0}>", cell, html_escape(entry));
  return html + "</tr>\n";
}

std::string table_of(const Study& study) {
  std::string html = "<div class=\"scroll\"><table>\n<thead>" + row_of("th", study.columns) + "</thead>\n<tbody>\n";
  for (const auto& row : study.rows) html += row_of("td", row);
  return html + "</tbody></table></div>\n";
}

std::string list_of(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string html = "<ul>\n";
  for (const std::string& note : notes) html += element("li", note);
  return html + "</ul>\n";
}

std::string maps_of(const Study& study, PageData& data) {
  if (study.densities.empty()) return "";
  std::vector<const core::CellField*> fields;
  fields.reserve(study.densities.size());
  for (const StudyMap& map : study.densities) fields.push_back(&map.field);
  const ValueScale scale = common_scale(fields);
  std::string figures;
  for (const StudyMap& map : study.densities)
    figures += map_figure({map.title, map.caption, &map.field, nullptr, "", "density", scale}, data);
  return element("h2", "Densities") + figure_group("three", figures, "study-maps");
}

/// Characters, not bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::string study_html(const Study& study) {
  PageData data;
  std::string figures;
  for (const CurvePlot& plot : study.plots) figures += curve_figure(plot, "", data);
  std::string body = element("h1", study.title);
  body += "<p class=\"sub\">Evenglow " + html_escape(study.version) + "</p>\n";
  body += element("p", study.lead);
  body += figure_group("two", figures, "");
  body += table_of(study);
  body += list_of(study.notes);
  body += maps_of(study, data);
  body += element("h2", "How to repeat") + element("pre", study.command);
  if (!study.run_file.empty())
    body += "<details><summary>The run file</summary>\n" + element("pre", study.run_file) + "</details>\n";
  return html_page(study.title, body, data.json());
}

void write_study_png(const Study& study, const std::filesystem::path& path) {
  constexpr double kText = 26.0;
  constexpr int kWidth = 1600;
  constexpr int kPlot = 640;
  CairoDrawing drawing(kWidth, 80 + kPlot * static_cast<int>(std::max<std::size_t>(1, study.plots.size())));
  const TextStyle heading{1.15 * kText, Align::left, Ink::text, true, false};
  drawing.text({40, 52}, fitted(drawing, study.title, heading, kWidth - 80), heading);
  double top = 80;
  for (const CurvePlot& plot : study.plots) {
    draw_curves(drawing, plot, {40, top, kWidth - 80.0, kPlot - 20.0}, kText, true);
    top += kPlot;
  }
  drawing.save(path);
}

std::string study_text(const Study& study) {
  std::vector<std::size_t> widths(study.columns.size(), 0);
  const auto measure = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  };
  measure(study.columns);
  for (const auto& row : study.rows) measure(row);
  const auto line = [&](const std::vector<std::string>& row) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths[i] - width_of(row[i]), ' ');
      text += (i == 0 ? row[i] + fill : "  " + fill + row[i]);
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
  };
  std::string text = line(study.columns);
  for (const auto& row : study.rows) text += line(row);
  return text;
}

}  // namespace evenglow::design
