#include "design/report/html_energy.h"

#include <fmt/format.h>

#include "design/report/energy_flow.h"
#include "design/report/energy_rows.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
std::string energy_section(const std::vector<const Report*>& reports) {
  const EnergyRows account(reports);
  const bool several = reports.size() > 1;
  std::string flows;
  std::string head = "<th>of the emitted flux</th>";
  std::string sums = "<th>sum</th>";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    flows += "<figure class=\"flows\">" +
             (several ? "<figcaption>" + html_escape(reports[i]->variant) + "</figcaption>\n" : std::string()) +
             "<div class=\"scroll\">" + energy_flow(account, i, reports[i]->energy.emitted_lm) + "</div></figure>\n";
    head += "<th class=\"n\">" + (several ? html_escape(reports[i]->variant) : std::string("share")) + "</th>";
    sums += "<td class=\"n\">" + fmt::format("{:.4f}\u00a0%", 100.0 * account.sum(i)) + "</td>";
  }
  std::string rows;
  for (std::size_t i = 0; i < account.rows().size(); ++i) {
    const Destination& row = account.rows()[i];
    rows += fmt::format("<tr><td><span class=\"swatch {}\"></span>{}</td>", energy_class(i), html_escape(row.label));
    for (const auto& share : row.shares) rows += "<td class=\"n\">" + (share ? percent(*share) : "\u2013") + "</td>";
    rows += "</tr>\n";
  }
  return "<div class=\"two\">\n" + flows + "</div>\n<div class=\"scroll\"><table>\n<thead><tr>" + head +
         "</tr></thead>\n<tbody>\n" + rows + "<tr class=\"sum\">" + sums + "</tr>\n</tbody></table></div>\n";
}

}  // namespace evenglow::design
