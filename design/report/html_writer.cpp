#include "design/report/html_writer.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/report/histogram_plot.h"
#include "design/report/html_dots.h"
#include "design/report/html_energy.h"
#include "design/report/html_facts.h"
#include "design/report/html_figures.h"
#include "design/report/html_films.h"
#include "design/report/html_maps.h"
#include "design/report/html_metrology.h"
#include "design/report/html_page.h"
#include "design/report/html_spots.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/page_data.h"
#include "design/report/report_curves.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

using Reports = std::vector<const Report*>;

std::string heading(const std::string& text) {
  return "<h2>" + html_escape(text) + "</h2>\n";
}

std::string paragraph(const std::string& text) {
  return "<p class=\"def\">" + html_escape(text) + "</p>\n";
}

std::string convergence_part(const Reports& reports, PageData& data) {
  const bool several = reports.size() > 1;
  const std::string note = several ? "diamond: final trace" : "";
  const std::string rms_note = several ? "solid: noise taken off; dashed: raw; " + note : "";
  return figure_group(
      "two",
      joined({curve_figure(rms_plot(reports), rms_note, data), curve_figure(efficiency_plot(reports), note, data)}),
      "");
}

std::string evenness_part(const Reports& reports, PageData& data) {
  const bool spread = std::any_of(reports.begin(), reports.end(), [](const Report* report) {
    return report->luminance.values.size() > 1 && report->final.luminance_mean.value > 0.0;
  });
  if (!spread) return {};  // one cell, or none with light
  const std::string histogram = curve_figure(luminance_histogram(reports), "of the active area", data);
  return heading("Distribution of the luminance") + figure_group("two", histogram, "") + spot_table(reports);
}

double greatest_angular(const Reports& reports) {
  double top = 0.0;
  for (const Report* report : reports) {
    if (!report->angular) continue;
    for (const core::Estimate& e : report->angular->luminance) {
      top = std::max(top, std::isfinite(e.value) ? e.value : 0.0);
    }
  }
  return top > 0.0 ? top : 1.0;
}

std::string angular_part(const Reports& reports, PageData& data) {
  const double top = greatest_angular(reports);
  std::string discs;
  for (const Report* report : reports) {
    if (!report->angular) continue;
    discs += polar_figure(reports.size() == 1 ? "All directions" : "All directions: " + report->variant,
                          *report->angular, top, data);
  }
  if (discs.empty()) return "";
  return heading("Luminance by direction of view") + paragraph("Averaged over the active area.") +
         figure_group("two",
                      joined({curve_figure(angular_section(reports, SectionDirection::along_x), "", data),
                              curve_figure(angular_section(reports, SectionDirection::along_y), "", data)}),
                      "") +
         half_angle_table(reports) + figure_group("three", discs, "");
}

std::string energy_part(const Reports& reports) {
  return heading("Where the light went") +
         paragraph(
             "Shares of the flux that the LEDs emit; \"leaves by\" is light that leaves the backlight on that side.") +
         energy_section(reports);
}

std::string notes_part(const Report& report) {
  const std::string notes = note_list(report);
  return notes.empty() ? "" : heading("Notes") + notes;
}

std::string section_view_part(const Report& report) {
  if (report.section_svg.empty()) return "";
  return heading("The stack in section") +
         paragraph(
             "The ways of a few photons through the first millimeters, colored by polarization; a full dot: it "
             "leaves the backlight, a ring: it is absorbed. Heights are not to scale.") +
         "<figure class=\"section\">" + report.section_svg + "</figure>\n";
}

/// All of one run below its headline figures.
std::string run_body(const Report& report, const std::string& id, PageData& data) {
  const Reports alone{&report};
  std::string steps;
  if (report.steps.size() > 1) {
    steps = heading("Convergence") + convergence_part(alone, data) +
            "<details><summary>The steps in figures</summary>\n" + step_table(report) + "</details>\n";
  }
  return joined({headline_cards(report), notes_part(report), steps, heading("Luminance and density"),
                 run_maps(report, id, data), dots_section(report, id, data), evenness_part(alone, data),
                 hot_spot_section(report, data), color_section(report, data), angular_part(alone, data),
                 energy_part(alone), film_table(report), section_view_part(report), heading("How to repeat"),
                 repeat_table(report), run_file_fold(report)});
}

std::string title_of(const std::string& title, const char* otherwise) {
  return title.empty() ? otherwise : title;
}

std::string top(const std::string& title, const std::string& subtitle) {
  return "<h1>" + html_escape(title) + "</h1>\n<p class=\"sub\">" + html_escape(subtitle) + "</p>\n";
}

std::string variant_parts(const Reports& reports, PageData& data) {
  return joined({heading("Luminance"), variant_luminance_maps(reports, data), heading("Convergence"),
                 convergence_part(reports, data), heading("Density of the microstructure"),
                 variant_density_maps(reports, data), relation_maps(reports, data), evenness_part(reports, data)});
}

std::string variant_folds(const Reports& reports, PageData& data) {
  std::string html = heading("Each variant");
  for (std::size_t i = 0; i < reports.size(); ++i) {
    html += "<details class=\"variant\"><summary>" + html_escape(reports[i]->variant) + ": " +
            html_escape(reports[i]->stop_reason) + "</summary>\n" + run_body(*reports[i], fmt::format("-{}", i), data) +
            "</details>\n";
  }
  return html;
}

}  // namespace

std::string report_html(const Report& report) {
  PageData data;
  const std::string title = title_of(report.title, "Backlight");
  std::string subtitle;
  for (const std::string& part : {report.variant, report.stop_reason}) {
    if (!part.empty()) subtitle += part + " \u00b7 ";
  }
  subtitle += "Evenglow " + report.version;
  const std::string body = top(title, subtitle) + run_body(report, "", data);
  return html_page(title, body, data.json());
}

std::string report_html(const Comparison& comparison) {
  PageData data;
  Reports reports;
  std::string names;
  for (const Report& report : comparison.variants) {
    reports.push_back(&report);
    names += (names.empty() ? "" : ", ") + report.variant;
  }
  const std::string title = title_of(comparison.title, "Comparison");
  const std::string version = comparison.variants.empty() ? "" : " \u00b7 Evenglow " + comparison.variants[0].version;
  const std::string body = joined({top(title, "Designs side by side: " + names + version), ratio_cards(comparison),
                                   heading("Final figures"), final_table(reports), variant_parts(reports, data),
                                   angular_part(reports, data), energy_part(reports), heading("How to repeat"), "<pre>",
                                   html_escape(comparison.command), "</pre>\n", variant_folds(reports, data)});
  return html_page(title, body, data.json());
}

void HtmlWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_file(directory / "report.html", report_html(report));
}

void HtmlWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  write_file(directory / "report.html", report_html(comparison));
}

}  // namespace evenglow::design
