#include "design/report/html_facts.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "design/report/number_format.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

std::string card(const std::string& name, const std::string& value, const std::string& unit,
                 const std::string& definition) {
  return fmt::format("<div class=\"card\"><h3>{}</h3><strong>{}{}</strong><p class=\"def\">{}</p></div>\n",
                     html_escape(name), html_escape(value),
                     unit.empty() ? "" : " <small>" + html_escape(unit) + "</small>", html_escape(definition));
}

constexpr const char* kDark = "\u2013 (no light in the viewing cone)";

bool is_dark(const FinalJudgment& f) {
  return f.luminance_mean.value <= 0.0;
}

/// Not "+-" where the error is not known.
std::string with_error(double value, double se, double factor = 1.0) {
  return std::isfinite(se) ? measured({value, se}, factor) : rounded(factor * value);
}

/// A figure of evenness, which only a display with light, and of more cells than one, has.
std::string evenness_text(const Report& r, const std::string& text) {
  if (is_dark(r.final)) return kDark;
  return r.luminance.values.size() == 1 ? "\u2013 (at least two cells are needed)" : text;
}

std::string gain_text(const core::Estimate& ratio) {
  const char* sign = ratio.value >= 1.0 ? "+" : "";
  return fmt::format("{}{}\u00a0%", sign, measured({100.0 * (ratio.value - 1.0), 100.0 * ratio.se}));
}

struct FinalRow {
  const char* name;
  const char* unit;
  std::function<std::string(const Report&)> value;
};

std::vector<FinalRow> color_rows() {
  const auto of = [](core::Estimate ColorJudgment::*figure) {
    return [figure](const Report& r) { return r.color ? measured((*r.color).*figure) : std::string(); };
  };
  return {{"color temperature", "K",
           [](const Report& r) { return r.color ? measured(r.color->mean.kelvin) : std::string(); }},
          {"\u0394u\u2032v\u2032 from the mean color, RMS", "", of(&ColorJudgment::rms_corrected)},
          {"\u0394u\u2032v\u2032 from the mean color, greatest", "", of(&ColorJudgment::max_corrected)},
          {"\u0394u\u2032v\u2032 of display from sources", "", of(&ColorJudgment::shift)}};
}

std::vector<FinalRow> final_rows() {
  const auto per_lumen = [](const Report& r) {
    const double lumen = r.energy.emitted_lm;
    return measured({r.final.luminance_mean.value / lumen, r.final.luminance_mean.se / lumen});
  };
  return {
      {"mean luminance", "cd/m\u00b2", [](const Report& r) { return measured(r.final.luminance_mean); }},
      {"mean luminance per lumen", "cd/m\u00b2/lm", per_lumen},
      {"luminance in the center", "cd/m\u00b2",
       [](const Report& r) { return with_error(r.final.luminance_center, r.final.luminance_center_se); }},
      {"efficiency", "%", [](const Report& r) { return measured(r.final.efficiency, 100.0); }},
      {"RMS, noise taken off", "%",
       [](const Report& r) { return evenness_text(r, measured(r.final.rms_corrected, 100.0)); }},
      {"RMS, raw", "%", [](const Report& r) { return evenness_text(r, rounded(100.0 * r.final.rms)); }},
      {"uniformity of 9 spots", "%",
       [](const Report& r) {
         return evenness_text(r, with_error(r.final.uniformity_9, r.final.uniformity_9_se, 100.0));
       }},
      {"uniformity of 13 spots", "%",
       [](const Report& r) {
         return evenness_text(r, with_error(r.final.uniformity_13, r.final.uniformity_13_se, 100.0));
       }},
      {"mean density", "", [](const Report& r) { return rounded(summarize(r.density).mean); }},
      {"flux of the LEDs", "lm", [](const Report& r) { return rounded(r.energy.emitted_lm); }},
      {"photons of the final trace", "", [](const Report& r) { return grouped(r.final.photons); }},
      {"steps", "", [](const Report& r) { return std::to_string(r.steps.size()); }},
      {"computing time (CPU)", "", [](const Report& r) { return duration(r.timing.cpu_s); }},
  };
}

}  // namespace

std::string headline_cards(const Report& report) {
  const FinalJudgment& f = report.final;
  const bool has_evenness = !is_dark(f) && report.luminance.values.size() != 1;
  const std::string origin = report.steps.size() > 1 ? "All from a final trace of " + grouped(f.photons) +
                                                           " photons with fresh random numbers; "
                                                     : "All from one trace of " + grouped(f.photons) + " photons; ";
  return "<div class=\"cards\">\n" +
         card("Evenness (RMS)", evenness_text(report, measured(f.rms_corrected, 100.0)), has_evenness ? "%" : "",
              "Standard deviation over mean of the luminance of the cells of the active area, the Monte Carlo variance "
              "taken off. Raw: " +
                  evenness_text(report, rounded(100.0 * f.rms) + " %") + ".") +
         card("Efficiency", measured(f.efficiency, 100.0), "%",
              "Luminous flux that leaves the top film within the hemisphere, over the flux of the LEDs.") +
         card("Mean luminance", measured(f.luminance_mean), "cd/m\u00b2",
              "Of the active area, for " + rounded(report.energy.emitted_lm) + " lm of LED flux. Center: " +
                  with_error(f.luminance_center, f.luminance_center_se) + " cd/m\u00b2.") +
         card("Uniformity",
              evenness_text(report, std::isfinite(f.uniformity_9_se)
                                        ? with_error(f.uniformity_9, f.uniformity_9_se, 100.0)
                                        : rounded(100.0 * f.uniformity_9, 3)),
              has_evenness ? "% of 9 spots" : "",
              "Least over greatest luminance of 9 spots of the active area; of 13 spots: " +
                  evenness_text(report, (std::isfinite(f.uniformity_13_se)
                                             ? with_error(f.uniformity_13, f.uniformity_13_se, 100.0)
                                             : rounded(100.0 * f.uniformity_13, 3)) +
                                            " %") +
                  ". Noise lowers a least over a greatest.") +
         "</div>\n<p class=\"def\">" + origin + "\u00b1 is one standard error.</p>\n";
}

std::string ratio_cards(const Comparison& comparison) {
  std::string cards;
  std::string rows;
  for (const VariantRatio& ratio : comparison.ratios) {
    cards += card("Luminance, " + ratio.name, measured(ratio.luminance), gain_text(ratio.luminance),
                  "Mean luminance of the two designs for equal flux of the LEDs.");
    rows += "<tr><td>" + html_escape(ratio.name) + "</td>";
    for (const core::Estimate& value : {ratio.luminance, ratio.flux, ratio.efficiency}) {
      rows += "<td class=\"n\">" + measured(value) + "</td>";
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) return "";
  return "<div class=\"cards\">\n" + cards +
         "</div>\n<div class=\"scroll\"><table>\n<thead><tr><th>ratio</th><th class=\"n\">luminance</th>"
         "<th class=\"n\">flux</th><th class=\"n\">efficiency</th></tr></thead>\n<tbody>\n" +
         rows +
         "</tbody></table></div>\n<p class=\"def\">For equal flux of the LEDs. Flux: luminous flux that leaves the top "
         "within the hemisphere. Efficiency: its share of the LED flux. Each design is made and judged on its own; "
         "\u00b1 is one standard error.</p>\n";
}

std::string final_table(const std::vector<const Report*>& reports) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th></th>";
  for (const Report* report : reports) html += "<th class=\"n\">" + html_escape(report->variant) + "</th>";
  html += "<th></th></tr></thead>\n<tbody>\n";
  std::vector<FinalRow> rows = final_rows();
  if (std::any_of(reports.begin(), reports.end(), [](const Report* r) { return r->color.has_value(); })) {
    for (const FinalRow& row : color_rows()) rows.push_back(row);
  }
  for (const FinalRow& row : rows) {
    html += fmt::format("<tr><td>{}</td>", row.name);
    for (const Report* report : reports) html += "<td class=\"n\">" + html_escape(row.value(*report)) + "</td>";
    html += fmt::format("<td>{}</td></tr>\n", row.unit);
  }
  return html + "</tbody></table></div>\n";
}

std::string step_table(const Report& report) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"n\">step</th><th class=\"n\">photons</th><th "
      "class=\"n\">RMS raw "
      "(%)</th><th class=\"n\">noise taken off (%)</th><th class=\"n\">efficiency (%)</th><th class=\"n\">mean "
      "density</th><th class=\"n\">mean luminance (cd/m\u00b2)</th></tr></thead>\n<tbody>\n";
  for (const StepRecord& s : report.steps) {
    html += fmt::format("<tr><td class=\"n\">{}</td>", s.step);
    for (const std::string& value :
         {grouped(s.photons), rounded(100.0 * s.rms), measured(s.rms_corrected, 100.0), measured(s.efficiency, 100.0),
          rounded(s.mean_density), rounded(s.luminance_mean)}) {
      html += "<td class=\"n\">" + value + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string note_list(const Report& report) {
  std::vector<std::string> of_films;  // stand in the table of the films
  for (std::size_t i = 0; i < report.films.size(); ++i) {
    for (const std::string& remark : report.films[i].remarks) of_films.push_back(film_note(i, report.films[i], remark));
  }
  std::string items;
  for (const std::string& note : report.notes) {
    if (std::find(of_films.begin(), of_films.end(), note) == of_films.end())
      items += "<li>" + html_escape(note) + "</li>\n";
  }
  return items.empty() ? "" : "<ul>\n" + items + "</ul>\n";
}

std::string fact_table(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string html = "<table class=\"facts\"><tbody>\n";
  for (const auto& [name, text] : facts) {
    html += "<tr><th>" + html_escape(name) + "</th><td>" + html_escape(text) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string repeat_table(const Report& report) {
  std::string changes;
  for (const std::string& change : report.overrides) changes.append(changes.empty() ? "" : "\n").append(change);
  std::vector<std::pair<std::string, std::string>> facts{{"Version", report.version},
                                                         {"Seed", std::to_string(report.seed)},
                                                         {"SHA-256 of the run file", report.run_file_sha256}};
  if (!changes.empty()) facts.emplace_back("Changes to the run file", changes);
  facts.emplace_back("Luminance", report.luminance_estimator);
  if (!report.processor.empty()) facts.emplace_back("Processor", report.processor);
  facts.emplace_back("Time", duration(report.timing.wall_s) + " (" + duration(report.timing.cpu_s) + " CPU) on " +
                                 std::to_string(report.threads) + " threads, " + std::to_string(report.ranks) +
                                 " ranks; " + rounded(report.timing.photons_per_cpu_s, 3) + " photons per CPU second");
  return "<pre>" + html_escape(report.command) + "</pre>\n" + fact_table(facts);
}

std::string run_file_fold(const Report& report) {
  return "<details><summary>The run file</summary>\n<pre>" + html_escape(report.run_file_text) + "</pre></details>\n";
}

}  // namespace evenglow::design
