#include "design/report/html_spots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/problem/merit.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kNine = 9;

struct Column {
  std::string name;
  std::vector<SpotValue> spots;

  double greatest() const {
    double most = 0.0;
    for (const SpotValue& spot : spots) {
      if (std::isfinite(spot.luminance)) most = std::max(most, spot.luminance);
    }
    return most;
  }
};

std::string number_cell(const std::string& text) {
  return "<td class=\"n\">" + text + "</td>";
}

std::string row_of(const std::vector<Column>& columns, std::size_t i) {
  const SpotValue& place = columns.front().spots[i];
  std::string html = fmt::format("<tr><td class=\"n\">{}</td>{}{}<td>{}</td>", i + 1, number_cell(rounded(place.x)),
                                 number_cell(rounded(place.y)), i < kNine ? "9 and 13" : "13");
  for (const Column& column : columns) {
    const double value = column.spots[i].luminance;
    html += number_cell(rounded(value)) +
            number_cell(column.greatest() > 0.0 ? rounded(100.0 * value / column.greatest()) : "\u2013");
  }
  return html + "</tr>\n";
}

}  // namespace

std::string spot_table(const std::vector<const Report*>& reports) {
  std::vector<Column> columns;
  for (const Report* report : reports) {
    if (!is_filled(report->luminance)) continue;
    columns.push_back({report->variant, uniformity_spots(counted_only(report->luminance, report->target))});
  }
  if (columns.empty()) return "";
  std::string head =
      "<th class=\"n\">spot</th><th class=\"n\">x (mm)</th><th class=\"n\">y (mm)</th><th>counts in</th>";
  for (const Column& column : columns) {
    const std::string name = reports.size() > 1 ? html_escape(column.name) + ", " : "";
    head += "<th class=\"n\">" + name + "cd/m\u00b2</th><th class=\"n\">% of greatest</th>";
  }
  std::string rows;
  for (std::size_t i = 0; i < columns.front().spots.size(); ++i) rows += row_of(columns, i);
  return std::string("<details class=\"spots\"") + (reports.size() == 1 ? " open" : "") +
         "><summary>The 9 and 13 spots of the uniformity</summary>\n<div "
         "class=\"scroll\"><table>\n<thead><tr>" +
         head + "</tr></thead>\n<tbody>\n" + rows +
         "</tbody></table></div>\n<p class=\"def\">A spot is the mean of the cells within 4 % of the diagonal around "
         "the point. Uniformity: least over greatest of the first 9, and of all 13.</p></details>\n";
}

}  // namespace evenglow::design
