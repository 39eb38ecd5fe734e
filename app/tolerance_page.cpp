#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/tolerance_plots.h"
#include "app/tolerance_report.h"
#include "design/report/html_figures.h"
#include "design/report/html_page.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::app {
namespace {

using design::html_escape;

constexpr std::size_t kWorst = 10;

std::string element(const char* tag, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", tag, html_escape(text));
}

/// A table whose cells are HTML already.
std::string table(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll spots\"><table>\n<thead><tr>";
  for (const std::string& column : columns) html += "<th>" + html_escape(column) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::vector<std::vector<std::string>> escaped(std::vector<std::vector<std::string>> rows) {
  for (auto& row : rows) {
    for (std::string& cell : row) cell = html_escape(cell);
  }
  return rows;
}

std::string card(const std::string& title, const std::string& value, const std::string& below) {
  return fmt::format("<div class=\"card\"><h3>{}</h3><strong>{}</strong><span class=\"def\">{}</span></div>\n",
                     html_escape(title), html_escape(value), html_escape(below));
}

std::string cards(const ToleranceOutcome& o) {
  std::string html = "<div class=\"cards\">\n";
  if (o.summary.all) {
    const design::Yield& y = *o.summary.all;
    html += card("Yield against the limits", fmt::format("{:.1f} %", 100.0 * y.corrected.value),
                 fmt::format("noise taken off; 95 %: {:.1f} to {:.1f} %. As traced: {:.1f} %, {} of {} samples near a "
                             "limit",
                             100.0 * y.corrected.low, 100.0 * y.corrected.high, 100.0 * y.seen.value, y.near_limit,
                             o.run.samples.size()));
  }
  for (const std::size_t i : figure_order(o.spec())) {
    const design::Figure& f = design::kFigures[i];
    const design::Population& p = o.summary.figures[i].population;
    html +=
        card(std::string(f.title) + " (" + f.unit + ")", design::rounded(f.scale * p.mean.value),
             (p.spread.value > 0.0 ? "spread " + design::measured(p.spread, f.scale) : "no spread beyond the noise") +
                 "; nominal " + design::measured(o.run.reference[i], f.scale));
  }
  return html + "</div>\n";
}

/// An effect with a bar as long as its share of the largest.
std::string effect_cell(const core::Estimate& effect, double largest, double scale) {
  const double share = largest > 0.0 ? std::abs(effect.value) / largest : 0.0;
  return fmt::format(
      "<span style=\"display:block;white-space:nowrap\">{}</span><span style=\"display:block;height:7px;"
      "border-radius:2px;width:{:.0f}px;background:var({})\"></span>",
      html_escape(design::measured(effect, scale)), std::max(1.0, 110.0 * share),
      std::abs(effect.value) > 2.0 * effect.se ? "--s1" : "--rest");
}

std::string sensitivities(const ToleranceOutcome& o) {
  const auto names = design::parameter_names(o.spec());
  std::vector<std::string> columns = {"parameter"};
  std::vector<std::vector<std::string>> rows;
  rows.reserve(names.size() + 2);
  for (const std::string& name : names) rows.push_back({html_escape(name)});
  rows.push_back({"explained share of the variance as traced"});
  for (const std::size_t i : figure_order(o.spec())) {
    const auto& s = o.summary.figures[i].sensitivity;
    if (!s) continue;
    const design::Figure& f = design::kFigures[i];
    columns.push_back(fmt::format("{} ({})", f.title, f.unit));
    double largest = 0.0;
    for (const core::Estimate& effect : s->effects) largest = std::max(largest, std::abs(effect.value));
    for (std::size_t p = 0; p < names.size(); ++p) rows[p].push_back(effect_cell(s->effects[p], largest, f.scale));
    rows.back().push_back(fmt::format("{:.0f} %", 100.0 * s->explained));
  }
  std::string html = element("h2", "What the spread comes from");
  if (columns.size() == 1)
    return html +
           element("p", "Not told: the samples are too few for so many parameters, or each dot varies for itself.");
  html += element("p",
                  "Change of each figure for one standard deviation of a parameter, the others held (linear regression "
                  "over all samples, with standard errors; gray where it is below two of them). What is not explained "
                  "is noise, curved, or comes from which LED or place it was.");
  return html + table(columns, rows);
}

std::string worst_samples(const ToleranceOutcome& o) {
  std::vector<std::string> columns = {"sample"};
  const auto order = figure_order(o.spec());
  for (const std::size_t i : order)
    columns.push_back(fmt::format("{} ({})", design::kFigures[i].title, design::kFigures[i].unit));
  for (const std::string& name : design::parameter_names(o.spec())) columns.push_back(name);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < std::min(kWorst, o.summary.worst.size()); ++k) {
    const int number = o.summary.worst[k];
    const design::SampleResult& s = o.run.samples[static_cast<std::size_t>(number - 1)];
    std::vector<std::string> row = {std::to_string(number)};
    for (const std::size_t i : order)
      row.push_back(html_escape(design::measured(s.figures[i], design::kFigures[i].scale)));
    for (const double value : s.parameters) row.push_back(design::rounded(value));
    rows.push_back(std::move(row));
  }
  return element("h2", "The worst samples") +
         element("p",
                 o.spec().limits.empty()
                     ? "By their RMS."
                     : "By how far they miss, or keep, their tightest limit, in standard deviations of the figure.") +
         table(columns, rows) + element("p", "To see one of them whole, with more photons:") +
         element("pre", fmt::format("{} --sample {} -o out/sample_{}", o.command, o.summary.worst.front(),
                                    o.summary.worst.front()));
}

std::string maps(const ToleranceOutcome& o, design::PageData& data) {
  const design::SpreadMaps maps = o.run.maps.maps(o.spec().common_numbers, kMapSmoothing);
  core::CellField level = maps.deviation, shape = maps.shape;
  for (std::size_t i = 0; i < level.values.size(); ++i) {
    level.values[i] = maps.mean.values[i] > 0.0 ? 100.0 * level.values[i] / maps.mean.values[i] : 0.0;
    shape.values[i] *= 100.0;
  }
  const auto scale = design::common_scale({&level, &shape});
  const auto mean_scale = design::common_scale({&maps.mean});
  const std::string figures =
      design::map_figure({"Mean of the samples", "luminance, cd/m\u00b2", &maps.mean, nullptr, "cd/m\u00b2",
                          "luminance", mean_scale, "mean"},
                         data) +
      design::map_figure({"Spread of the luminance", "standard deviation over the samples, % of the cell's mean",
                          &level, nullptr, "%", "density", scale, "spread"},
                         data) +
      design::map_figure({"Spread of the shape", "the same of the luminance over each sample's own mean, %", &shape,
                          nullptr, "%", "density", scale, "spread"},
                         data);
  return element("h2", "Where the samples differ") +
         element("p",
                 "The Monte Carlo variance of the traces is taken off each cell; where it is larger than the "
                 "spread, 0 is shown.") +
         design::figure_group("three", figures, "");
}

std::string lead(const ToleranceOutcome& o) {
  const design::ToleranceSpec& spec = o.spec();
  std::string text = fmt::format(
      "{} backlights, drawn as production makes them about the nominal design, each traced with {} photons {}. ",
      o.run.samples.size(), design::grouped(spec.photons),
      spec.common_numbers ? "and the same random numbers" : "and random numbers of its own");
  text +=
      spec.common_numbers
          ? "The Monte Carlo noise is common to all samples: it shifts them alike, so that nothing is taken off the "
            "spread, and the means are off by about the noise of one sample."
          : "The spread is the standard deviation of the samples with the variance of their Monte Carlo noise taken "
            "off; \u00b1 are standard errors.";
  return text;
}

}  // namespace

std::string tolerance_html(const ToleranceOutcome& o) {
  design::PageData data;
  const design::Study study = tolerance_study(o);
  std::string plots;
  for (const design::CurvePlot& plot : study.plots) plots += design::curve_figure(plot, "", data);
  std::string body = element("h1", study.title);
  body += "<p class=\"sub\">Evenglow " + html_escape(study.version) + "</p>\n";
  body += element("p", lead(o));
  body += cards(o);
  if (!o.spec().limits.empty()) {
    body += element("h2", "Yield") + table(yield_columns(), escaped(yield_rows(o)));
    body +=
        "<p class=\"def\">Intervals by Wilson (1927). Near a limit: samples within two standard errors of one that "
        "decides; their noise may flip them. Noise taken off: the samples drawn together to the spread of the "
        "population.</p>\n";
  }
  body += element("h2", "Figures") + table(study.columns, escaped(study.rows));
  const core::Estimate& shift = o.summary.figures[1].shift;
  body +=
      element("p", fmt::format("The noise of the traces shifts the uniformity of 9 spots by {} percentage points on "
                               "average: it is in the columns from mean to greatest, and taken off where noise is.",
                               design::measured(shift, 100.0)));
  body += design::figure_group("two", plots, "");
  body += sensitivities(o);
  body += worst_samples(o);
  body += maps(o, data);
  body += element("h2", "How to repeat") + element("pre", study.command);
  body += "<details><summary>The run file</summary>\n" + element("pre", study.run_file) + "</details>\n";
  return design::html_page(study.title, body, data.json());
}

}  // namespace evenglow::app
