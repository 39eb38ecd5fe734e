#include "design/report/html_films.h"

#include <fmt/format.h>

#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

std::string remarks_of(const FilmEntry& film) {
  std::string html;
  for (const std::string& remark : film.remarks) html += (html.empty() ? "" : "<br>") + html_escape(remark);
  return html;
}

}  // namespace

std::string film_table(const Report& report) {
  if (report.films.empty()) return "";
  std::string rows;
  for (std::size_t i = 0; i < report.films.size(); ++i) {
    const FilmEntry& film = report.films[i];
    rows +=
        fmt::format("<tr><td>films[{}]</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
                    i, html_escape(film.kind), rounded(film.axis_deg), rounded(film.gap_mm), remarks_of(film));
  }
  return "<h2>Films</h2>\n<div class=\"scroll\"><table class=\"films\">\n<thead><tr><th>film</th><th>kind</th><th "
         "class=\"n\">axis (\u00b0)</th><th class=\"n\">gap below (mm)</th><th>remarks on its data</th></tr></thead>\n"
         "<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace evenglow::design
