#include "design/report/html_writer.h"

#include <algorithm>
#include <cmath>

#include "design/report/html_energy.h"
#include "design/report/html_facts.h"
#include "design/report/html_figures.h"
#include "design/report/html_metrology.h"
#include "design/report/html_page.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/page_data.h"
#include "design/report/report_curves.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

constexpr const char* luminance_unit = "cd/m\u00b2";

using Reports = std::vector<const Report*>;

std::string heading(const std::string& text) {
  return "<h2>" + html_escape(text) + "</h2>\n";
}

std::string paragraph(const std::string& text) {
  return "<p class=\"def\">" + html_escape(text) + "</p>\n";
}

std::string range_text(const core::CellField& field, const std::string& unit) {
  const FieldSummary s = summarize(field);
  return "mean " + rounded(s.mean) + ", " + rounded(s.min) + " \u2026 " + rounded(s.max) +
         (unit.empty() ? "" : " " + unit);
}

MapFigure luminance_map(const std::string& title, const core::CellField& field, const core::CellField* se,
                        const ValueScale& scale) {
  return {title, range_text(field, luminance_unit), &field, se, luminance_unit, "luminance", scale};
}

MapFigure density_map(const std::string& title, const Report& report, const ValueScale& scale) {
  return {title, range_text(report.density, ""), &report.density, nullptr, "", "density", scale};
}

bool is_design(const Report& report) {
  return report.steps.size() > 1 && is_filled(report.start_luminance);
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

std::string run_maps(const Report& report, const std::string& id, PageData& data) {
  std::string figures;
  if (is_design(report)) {
    const ValueScale scale = common_scale({&report.start_luminance, &report.luminance});
    figures = map_figure(luminance_map("Luminance at the start", report.start_luminance, nullptr, scale), data);
    figures += map_figure(luminance_map("Luminance, final", report.luminance, &report.luminance_se, scale), data);
  } else {
    const ValueScale scale = common_scale({&report.luminance});
    figures = map_figure(luminance_map("Luminance", report.luminance, &report.luminance_se, scale), data);
  }
  std::string rest =
      map_figure(density_map("Density of the microstructure", report, common_scale({&report.density})), data);
  rest += map_figure(luminance_map("Standard error of the luminance", report.luminance_se, nullptr,
                                   common_scale({&report.luminance_se})),
                     data);
  const std::string limits = paragraph("The design may choose densities from " + rounded(report.density_min) + " to " +
                                       rounded(report.density_max) + ".");
  if (!is_design(report)) return figure_group("three", figures + rest, "");
  return figure_group("two", figures, id) + figure_group("two", rest, "") + limits;
}

std::string section_part(const Reports& reports, PageData& data) {
  const std::string note = "band: one standard error";
  return figure_group("two",
                      joined({curve_figure(luminance_section(reports, SectionDirection::along_x), note, data),
                              curve_figure(luminance_section(reports, SectionDirection::along_y), note, data)}),
                      "");
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

/// All of one run below its headline figures.
std::string run_body(const Report& report, const std::string& id, PageData& data) {
  const Reports alone{&report};
  std::string steps;
  if (report.steps.size() > 1) {
    steps = heading("Convergence") + convergence_part(alone, data) +
            "<details><summary>The steps in figures</summary>\n" + step_table(report) + "</details>\n";
  }
  return joined({headline_cards(report), notes_part(report), steps, heading("Luminance and density"),
                 run_maps(report, id, data), heading("Sections"), section_part(alone, data),
                 hot_spot_section(report, data), color_section(report, data), angular_part(alone, data),
                 energy_part(alone), heading("How to repeat"), repeat_table(report), run_file_fold(report)});
}

std::string title_of(const std::string& title, const char* otherwise) {
  return title.empty() ? otherwise : title;
}

std::string top(const std::string& title, const std::string& subtitle) {
  return "<h1>" + html_escape(title) + "</h1>\n<p class=\"sub\">" + html_escape(subtitle) + "</p>\n";
}

std::string variant_maps(const Reports& reports, PageData& data) {
  std::vector<const core::CellField*> luminance;
  std::vector<const core::CellField*> density;
  for (const Report* report : reports) {
    luminance.push_back(&report->luminance);
    density.push_back(&report->density);
  }
  std::string luminance_maps;
  std::string density_maps;
  for (const Report* r : reports) {
    luminance_maps +=
        map_figure(luminance_map(r->variant, r->luminance, &r->luminance_se, common_scale(luminance)), data);
    density_maps += map_figure(density_map(r->variant, *r, common_scale(density)), data);
  }
  const std::string layout = reports.size() == 2 ? "two" : "three";
  return heading("Luminance") + figure_group(layout, luminance_maps, "luminance-maps") + heading("Convergence") +
         convergence_part(reports, data) + heading("Density of the microstructure") +
         figure_group(layout, density_maps, "density-maps");
}

std::string variant_folds(const Reports& reports, PageData& data) {
  std::string html = heading("Each variant");
  for (std::size_t i = 0; i < reports.size(); ++i) {
    html += "<details class=\"variant\"><summary>" + html_escape(reports[i]->variant) + ": " +
            html_escape(reports[i]->stop_reason) + "</summary>\n" +
            run_body(*reports[i], "maps-" + std::to_string(i), data) + "</details>\n";
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
  const std::string body = top(title, subtitle) + run_body(report, "maps", data);
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
  const std::string body =
      joined({top(title, "Designs side by side: " + names + version), ratio_cards(comparison), heading("Final figures"),
              final_table(reports), variant_maps(reports, data), heading("Sections"), section_part(reports, data),
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
