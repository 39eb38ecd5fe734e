#include "design/report/html_dots.h"

#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "design/report/html_figures.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

constexpr const char* luminance_unit = "cd/m\u00b2";

std::string def(const std::string& text) {
  return "<p class=\"def\">" + html_escape(text) + "</p>\n";
}

std::string cell(const std::string& text) {
  return "<td class=\"n\">" + text + "</td>";
}

/// Both judgments side by side.
std::string judgment_table(const Report& report) {
  const DotsJudgment& dots = *report.dots;
  struct Row {
    const char* name;
    const char* unit;
    std::function<std::string(const FinalJudgment&)> value;
  };
  const Row rows[] = {
      {"RMS, noise taken off", "%", [](const FinalJudgment& f) { return measured(f.rms_corrected, 100.0); }},
      {"mean luminance", luminance_unit, [](const FinalJudgment& f) { return measured(f.luminance_mean); }},
      {"uniformity of 9 spots", "%",
       [](const FinalJudgment& f) {
         return measured({f.uniformity_9, f.uniformity_9_se}, 100.0);
       }},
      {"uniformity of 13 spots", "%",
       [](const FinalJudgment& f) {
         return measured({f.uniformity_13, f.uniformity_13_se}, 100.0);
       }},
      {"efficiency", "%", [](const FinalJudgment& f) { return measured(f.efficiency, 100.0); }},
  };
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th></th><th class=\"n\">density</th><th class=\"n\">dots</th>"
      "<th></th></tr></thead>\n<tbody>\n";
  for (const Row& row : rows) {
    html += fmt::format("<tr><td>{}</td>{}{}<td>{}</td></tr>\n", row.name, cell(row.value(report.final)),
                        cell(row.value(dots.final)), row.unit);
  }
  html += fmt::format("<tr><td>mean luminance over that of the density</td>{}{}<td></td></tr>\n", cell("1"),
                      cell(measured(dots.over_density)));
  return html + "</tbody></table></div>\n";
}

std::string round_table(const DotsJudgment& dots) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"n\">round</th><th class=\"n\">dots</th>"
      "<th class=\"n\">area (mm\u00b2)</th><th class=\"n\">mean density</th><th class=\"n\">photons</th>"
      "<th class=\"n\">RMS, noise taken off (%)</th><th class=\"n\">mean luminance (cd/m\u00b2)</th>"
      "<th class=\"n\">over the density</th><th></th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < dots.rounds.size(); ++i) {
    const DotsRound& round = dots.rounds[i];
    html += "<tr>" + cell(std::to_string(round.record.step)) + cell(grouped(round.dots)) + cell(rounded(round.area)) +
            cell(rounded(round.record.mean_density)) + cell(grouped(round.record.photons)) +
            cell(measured(round.record.rms_corrected, 100.0)) + cell(measured(round.luminance)) +
            cell(measured(round.over_density)) + (i == dots.chosen ? "<td>chosen</td>" : "<td></td>") + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Dots over density, cell by cell, with its error.
struct RatioMap {
  core::CellField ratio, se;
};
RatioMap ratio_map(const Report& report) {
  const DotsJudgment& dots = *report.dots;
  RatioMap map{dots.luminance, dots.luminance_se};
  for (std::size_t i = 0; i < map.ratio.values.size(); ++i) {
    const double base = report.luminance.values[i], value = dots.luminance.values[i];
    const bool lit = base > 0.0 && value > 0.0;
    map.ratio.values[i] = lit ? value / base : std::numeric_limits<double>::quiet_NaN();
    map.se.values[i] =
        lit ? value / base * std::hypot(dots.luminance_se.values[i] / value, report.luminance_se.values[i] / base)
            : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

std::string range_text(const core::CellField& field, const std::string& unit) {
  const FieldSummary s = summarize(field);
  return "mean " + rounded(s.mean) + ", " + rounded(s.min) + " \u2026 " + rounded(s.max) +
         (unit.empty() ? "" : " " + unit);
}

std::string maps(const Report& report, const std::string& id, PageData& data) {
  const DotsJudgment& dots = *report.dots;
  if (report.luminance.values.size() != dots.luminance.values.size()) return "";
  const ValueScale scale = common_scale({&report.luminance, &dots.luminance});
  const auto luminance = [&](const std::string& title, const core::CellField& field, const core::CellField& se) {
    return map_figure(
        {title, range_text(field, luminance_unit), &field, &se, luminance_unit, "luminance", scale, "luminance"}, data);
  };
  const RatioMap ratio = ratio_map(report);
  const std::string figures = luminance("Luminance of the density", report.luminance, report.luminance_se) +
                              luminance("Luminance of the dots", dots.luminance, dots.luminance_se) +
                              map_figure({"Dots over density", range_text(ratio.ratio, ""), &ratio.ratio, &ratio.se, "",
                                          "luminance", common_scale({&ratio.ratio}), "ratio"},
                                         data);
  return figure_group("three", figures, "dots-maps" + id);
}

}  // namespace

std::string dots_section(const Report& report, const std::string& id, PageData& data) {
  if (!report.dots) return "";
  const DotsJudgment& dots = *report.dots;
  return "<h2>The design as real dots</h2>\n" +
         def("The density was placed as " + grouped(dots.rounds[dots.chosen].dots) +
             " dots, each traced where it lies. Both judgments are traces with random numbers that no step has seen.") +
         judgment_table(report) + "<h3>Rounds</h3>\n" +
         def("Round 0: the dots of the density as designed; each further round: of the density corrected by what the "
             "dots before have shown. Noise lowers the figures of the round that is chosen for being the best; the "
             "judgment above is free of that. " +
             dots.stop_reason + ".") +
         round_table(dots) + maps(report, id, data);
}

}  // namespace evenglow::design
