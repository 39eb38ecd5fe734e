#include "design/report/html_energy.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

constexpr std::size_t colors = 11;  ///< classes e0 to e10 of the style sheet; the last is for all the rest

/// One destination of light, with its share in each report (none: no such part there).
struct Destination {
  std::string label;
  bool wanted = false;  ///< the top
  std::vector<std::optional<core::Estimate>> shares;

  double greatest() const {
    double most = 0.0;
    for (const auto& share : shares) most = std::max(most, share ? share->value : 0.0);
    return most;
  }
};

class Account {
 public:
  explicit Account(const std::vector<const Report*>& reports) : count_(reports.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const EnergyAccount& energy = reports[i]->energy;
      for (const EnergyShare& s : energy.escaped) add("leaves by the " + s.name, s.name == "top", i, s.share);
      for (const EnergyShare& s : energy.absorbed) add("absorbed: " + s.name, false, i, s.share);
      add("lost photons (stopped by the program)", false, i, energy.lost);
    }
    std::stable_sort(rows_.begin(), rows_.end(), [](const Destination& a, const Destination& b) {
      return a.wanted != b.wanted ? a.wanted : a.greatest() > b.greatest();
    });
  }

  const std::vector<Destination>& rows() const { return rows_; }

  double sum(std::size_t report) const {
    double total = 0.0;
    for (const Destination& row : rows_) total += row.shares[report] ? row.shares[report]->value : 0.0;
    return total;
  }

 private:
  void add(const std::string& label, bool wanted, std::size_t report, const core::Estimate& share) {
    auto row = std::find_if(rows_.begin(), rows_.end(),
                            [&](const Destination& d) { return d.label == label && !d.shares[report]; });
    if (row == rows_.end()) {
      rows_.push_back({label, wanted, std::vector<std::optional<core::Estimate>>(count_)});
      row = rows_.end() - 1;
    }
    row->shares[report] = share;
  }

  std::size_t count_;
  std::vector<Destination> rows_;
};

std::string bar(const Account& account, std::size_t report) {
  std::string html = "<div class=\"stack\">";
  for (std::size_t i = 0; i < account.rows().size(); ++i) {
    const auto& share = account.rows()[i].shares[report];
    if (!share || !(share->value > 0.0)) continue;
    html += fmt::format("<i class=\"e{}\" style=\"width:{:.3f}%\" title=\"{}: {}\"></i>", std::min(i, colors - 1),
                        100.0 * share->value, html_escape(account.rows()[i].label), percent(*share));
  }
  return html + "</div>\n";
}

}  // namespace

std::string energy_section(const std::vector<const Report*>& reports) {
  const Account account(reports);
  const bool several = reports.size() > 1;
  std::string html;
  std::string head = "<th>of the emitted flux</th>";
  std::string sums = "<th>sum</th>";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (several) html += "<div>" + html_escape(reports[i]->variant) + "</div>\n";
    html += bar(account, i);
    head += "<th class=\"n\">" + (several ? html_escape(reports[i]->variant) : std::string("share")) + "</th>";
    sums += "<td class=\"n\">" + fmt::format("{:.4f}\u00a0%", 100.0 * account.sum(i)) + "</td>";
  }
  std::string rows;
  for (std::size_t i = 0; i < account.rows().size(); ++i) {
    const Destination& row = account.rows()[i];
    rows += fmt::format("<tr><td><span class=\"swatch e{}\"></span>{}</td>", std::min(i, colors - 1),
                        html_escape(row.label));
    for (const auto& share : row.shares) rows += "<td class=\"n\">" + (share ? percent(*share) : "\u2013") + "</td>";
    rows += "</tr>\n";
  }
  return html + "<div class=\"scroll\"><table>\n<thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows +
         "<tr class=\"sum\">" + sums + "</tr>\n</tbody></table></div>\n";
}

}  // namespace evenglow::design
