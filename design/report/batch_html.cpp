#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "design/report/base64.h"
#include "design/report/batch_table.h"
#include "design/report/html_page.h"
#include "design/report/number_format.h"
#include "design/report/page_data.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

/// A cell of the table; `sort` is what its column is sorted by.
struct Cell {
  std::string text;
  std::string sort;
  bool is_number = false;
};

/// A column's heading; `hint` is shown under the pointer.
struct Heading {
  std::string text, hint;
};

/// The last word of a key where no other key of the table ends with it.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  const auto last = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  const auto ends_alike = [&](const std::string& other) { return last(other) == last(key); };
  return std::count_if(keys.begin(), keys.end(), ends_alike) == 1 ? last(key) : key;
}

std::vector<Heading> headings(const std::vector<std::string>& keys) {
  std::vector<Heading> all = {{"Run", ""}, {"Status", ""}};
  for (const std::string& key : keys) all.push_back({short_key(key, keys), key});
  for (const char* name : {"RMS non-uniformity, %", "Mean luminance, cd/m\u00b2", "Efficiency, %", "Uniformity 9",
                           "Uniformity 13", "Photons", "CPU time", "Remark"}) {
    all.push_back({name, ""});
  }
  return all;
}

std::string header(const std::vector<Heading>& columns) {
  std::string html = "<thead><tr><th>Luminance</th>";
  for (const Heading& column : columns) {
    html += fmt::format("<th aria-sort=\"none\"><button type=\"button\" title=\"{}\">{}</button></th>",
                        html_escape(column.hint), html_escape(column.text));
  }
  return html + "</tr></thead>\n";
}

std::string cell_html(const Cell& cell) {
  return fmt::format("<td{} data-sort=\"{}\">{}</td>", cell.is_number ? " class=\"n\"" : "", html_escape(cell.sort),
                     cell.text);
}

Cell word(const std::string& text) {
  return {html_escape(text), text, false};
}

Cell number(const std::string& text, double value) {
  return {html_escape(text), shortest(value), true};
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string picture(const BatchRow& row, const std::filesystem::path& directory) {
  const std::string bytes =
      row.status == BatchStatus::kDone ? file_bytes(directory / row.name / "thumbnail.png") : std::string();
  if (bytes.empty()) return "<td></td>";
  return "<td><img alt=\"luminance of " + html_escape(row.name) + "\" src=\"data:image/png;base64," + base64(bytes) +
         "\"></td>";
}

/// A link that stays within the folder whatever the name holds.
std::string link_to(const BatchRow& row, const std::filesystem::path& directory) {
  const bool there = std::filesystem::exists(directory / row.name / "report.html");
  if (!there) return html_escape(row.name);
  return "<a href=\"./" + html_escape(row.name) + "/report.html\">" + html_escape(row.name) + "</a>";
}

std::vector<Cell> figures(const BatchRow& row) {
  if (row.status != BatchStatus::kDone) return std::vector<Cell>(7, Cell{"", "", true});
  const FinalJudgment& f = row.final;
  return {number(measured(f.rms_corrected, 100.0), f.rms_corrected.value),
          number(measured(f.luminance_mean), f.luminance_mean.value),
          number(measured(f.efficiency, 100.0), f.efficiency.value),
          number(rounded(f.uniformity_9, 3), f.uniformity_9),
          number(rounded(f.uniformity_13, 3), f.uniformity_13),
          number(grouped(f.photons), static_cast<double>(f.photons)),
          number(duration(row.cpu_s), row.cpu_s)};
}

std::string row_html(const BatchRow& row, const std::vector<std::string>& keys,
                     const std::filesystem::path& directory) {
  std::string html = fmt::format("<tr class=\"{}\">{}", status_name(row.status), picture(row, directory));
  html += cell_html({link_to(row, directory), row.name, false});
  html += cell_html(word(std::string(status_name(row.status))));
  for (const std::string& key : keys) {
    std::string value;
    for (const auto& [changed, to] : row.changes) value = changed == key ? to : value;
    html += cell_html(word(value));
  }
  for (const Cell& cell : figures(row)) html += cell_html(cell);
  return html + cell_html(word(row.message)) + "</tr>\n";
}

constexpr std::string_view kStyle = R"css(<style>
main { max-width: none; }
.batch { overflow-x: auto; }
.batch table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
.batch td, .batch th { padding: 5px 10px; border-bottom: 1px solid var(--line); text-align: left; vertical-align: middle;
  overflow-wrap: normal; }
.batch td.n { text-align: right; white-space: nowrap; }
.batch th button { all: unset; cursor: pointer; font-weight: 600; }
.batch th button:focus-visible { outline: 2px solid var(--accent); }
.batch th[aria-sort=ascending] button::after { content: " \2191"; } .batch th[aria-sort=descending] button::after { content: " \2193"; }
.batch td:nth-child(2) { overflow-wrap: anywhere; min-width: 18ch; }
.batch td:last-child { min-width: 30ch; font-size: .8rem; }
.batch img { display: block; width: 96px; image-rendering: pixelated; }
.batch tr.failed td, .batch tr.wrong_input td { color: var(--s6); }
.batch a { color: var(--accent); }
</style>
)css";

// Numbers are sorted as numbers; what is empty stays at the end.
constexpr std::string_view kScript = R"js(<script>
for (const head of document.querySelectorAll(".batch th button")) head.addEventListener("click", () => {
  const th = head.parentElement, table = th.closest("table"), column = th.cellIndex;
  const down = th.getAttribute("aria-sort") === "ascending";
  for (const other of table.querySelectorAll("th[aria-sort]")) other.setAttribute("aria-sort", "none");
  th.setAttribute("aria-sort", down ? "descending" : "ascending");
  const key = row => row.cells[column].dataset.sort;
  const rows = [...table.tBodies[0].rows].sort((a, b) => {
    const x = key(a), y = key(b);
    if (x === "" || y === "") return (x === "") - (y === "");
    const order = isNaN(x) || isNaN(y) ? x.localeCompare(y) : x - y;
    return down ? -order : order;
  });
  table.tBodies[0].append(...rows);
});
</script>
)js";

}  // namespace

std::string batch_html(const BatchTable& table, const std::filesystem::path& directory) {
  const auto keys = changed_keys(table);
  std::size_t done = 0;
  for (const BatchRow& row : table.rows) done += row.status == BatchStatus::kDone ? 1 : 0;
  std::string body(kStyle);
  body += "<h1>" + html_escape(table.title) + "</h1>\n<p class=\"sub\">" +
          html_escape(fmt::format("{} of {} runs done \u00b7 Evenglow {}", done, table.rows.size(), table.version)) +
          "</p>\n<p class=\"def\">A click on a heading sorts the table. RMS non-uniformity: Monte Carlo noise taken "
          "off; \u00b1 one standard error. Each picture has its own scale, from zero to its greatest luminance.</p>\n";
  if (const std::string left = left_over_text(table); !left.empty()) {
    body += "<p>Folders beside these runs, " + html_escape(left) + "; the table leaves them out.</p>\n";
  }
  body += "<div class=\"batch\"><table>" + header(headings(keys)) + "<tbody>\n";
  for (const BatchRow& row : table.rows) body += row_html(row, keys, directory);
  body += "</tbody></table></div>\n<h2>How to repeat</h2>\n<pre>" + html_escape(table.command) + "</pre>\n";
  return html_page(table.title, body + std::string(kScript), PageData().json());
}

}  // namespace evenglow::design
