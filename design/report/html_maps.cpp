#include "design/report/html_maps.h"

#include <algorithm>
#include <cmath>

#include "design/report/html_figures.h"
#include "design/report/map_relations.h"
#include "design/report/number_format.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

constexpr const char* luminance_unit = "cd/m\u00b2";

using Reports = std::vector<const Report*>;

std::string range_text(const core::CellField& field, const std::string& unit) {
  const FieldSummary s = summarize(field);
  return "mean " + rounded(s.mean) + ", " + rounded(s.min) + " \u2026 " + rounded(s.max) +
         (unit.empty() ? "" : " " + unit);
}

MapFigure luminance_map(const std::string& title, const core::CellField& field, const core::CellField* se,
                        const ValueScale& scale) {
  return {title, range_text(field, luminance_unit), &field, se, luminance_unit, "luminance", scale, "luminance"};
}

MapFigure density_map(const std::string& title, const Report& report, const ValueScale& scale) {
  return {title, range_text(report.density, ""), &report.density, nullptr, "", "density", scale, "density"};
}

bool is_design(const Report& report) {
  return report.steps.size() > 1 && is_filled(report.start_luminance);
}

std::string def(const std::string& text) {
  return "<p class=\"def\">" + html_escape(text) + "</p>\n";
}

std::string layout_of(std::size_t maps) {
  return maps % 3 == 0 || maps > 4 ? "three" : "two";
}

std::string side_maps(const Report& report, PageData& data) {
  MapFigure se = luminance_map("Standard error of the luminance", report.luminance_se, nullptr,
                               common_scale({&report.luminance_se}));
  se.quantity = "standard error";
  return map_figure(density_map("Density of the microstructure", report, common_scale({&report.density})), data) +
         map_figure(se, data);
}

/// With the place of its variant in the comparison, which gives its curves their color.
struct VariantMap {
  RelatedMap map;
  int variant = 0;
};

/// Zero in the middle of the colors.
ValueScale balanced(const std::vector<VariantMap>& maps) {
  double most = 0.0;
  for (const VariantMap& one : maps) {
    const FieldSummary s = summarize(one.map.field);
    most = std::max({most, std::abs(s.min), std::abs(s.max)});
  }
  return most > 0.0 ? ValueScale{-most, most} : ValueScale{-1.0, 1.0};
}

ValueScale common_scale_of(const std::vector<VariantMap>& maps) {
  std::vector<const core::CellField*> fields;
  fields.reserve(maps.size());
  for (const VariantMap& one : maps) fields.push_back(&one.map.field);
  return common_scale(fields);
}

/// How a group of related maps is shown.
struct Relation {
  const char* heading;
  const char* definition;
  const char* unit;
  const char* colors;
  const char* quantity;
  const char* id;
};

std::string relation_group(const std::vector<VariantMap>& maps, const Relation& shown, const ValueScale& scale,
                           PageData& data) {
  if (maps.empty()) return "";
  std::string figures;
  for (const auto& [map, variant] : maps) {
    figures +=
        map_figure({map.name, range_text(map.field, shown.unit), &map.field, map.se.values.empty() ? nullptr : &map.se,
                    shown.unit, shown.colors, scale, shown.quantity, variant},
                   data);
  }
  return std::string("<h3>") + shown.heading + "</h3>\n" + def(shown.definition) +
         figure_group(layout_of(maps.size() < 3 ? 2 : 3), figures, shown.id);
}

using Relate = std::optional<RelatedMap> (*)(const Report&, const Report&);

std::vector<VariantMap> related(const Reports& reports, Relate relate) {
  std::vector<VariantMap> maps;
  for (std::size_t i = 1; i < reports.size(); ++i) {
    if (auto map = relate(*reports[i], *reports[0])) maps.push_back({std::move(*map), static_cast<int>(i)});
  }
  return maps;
}

std::string unrelated(const Reports& reports) {
  std::string names;
  for (std::size_t i = 1; i < reports.size(); ++i) {
    if (!luminance_ratio(*reports[i], *reports[0])) names += (names.empty() ? "" : ", ") + reports[i]->variant;
  }
  return names.empty() ? "" : def("On other cells than " + reports[0]->variant + ", so not shown here: " + names + ".");
}

std::string variant_maps(const Reports& reports, core::CellField Report::*field, const char* id, PageData& data) {
  std::vector<const core::CellField*> fields;
  for (const Report* report : reports) fields.push_back(&(report->*field));
  const ValueScale scale = common_scale(fields);
  std::string figures;
  for (const Report* r : reports) {
    figures += map_figure(field == &Report::density ? density_map(r->variant, *r, scale)
                                                    : luminance_map(r->variant, r->luminance, &r->luminance_se, scale),
                          data);
  }
  return figure_group(layout_of(reports.size()), figures, id);
}

}  // namespace

std::string run_maps(const Report& report, const std::string& id, PageData& data) {
  if (!is_design(report)) {
    std::string map = map_figure(
        luminance_map("Luminance", report.luminance, &report.luminance_se, common_scale({&report.luminance})), data);
    return figure_group("three", map + side_maps(report, data), "maps" + id);
  }
  const ValueScale scale = common_scale({&report.start_luminance, &report.luminance});
  std::string maps = map_figure(luminance_map("Luminance at the start", report.start_luminance, nullptr, scale), data);
  maps += map_figure(luminance_map("Luminance, final", report.luminance, &report.luminance_se, scale), data);
  maps = figure_group("two", maps, "maps" + id);
  maps += figure_group("two", side_maps(report, data), "sides" + id);
  return maps + def("The design may choose densities from " + rounded(report.density_min) + " to " +
                    rounded(report.density_max) + ".");
}

std::string variant_luminance_maps(const Reports& reports, PageData& data) {
  return variant_maps(reports, &Report::luminance, "luminance-maps", data);
}

std::string variant_density_maps(const Reports& reports, PageData& data) {
  return variant_maps(reports, &Report::density, "density-maps", data);
}

std::string relation_maps(const Reports& reports, PageData& data) {
  if (reports.size() < 2) return "";
  const std::vector<VariantMap> ratios = related(reports, luminance_ratio);
  const std::vector<VariantMap> differences = related(reports, luminance_difference);
  const std::vector<VariantMap> densities = related(reports, density_difference);
  std::string html = "<h2>Ratios and differences</h2>\n";
  html += relation_group(
      ratios,
      {"Ratio of the luminance", "Cell by cell, for equal flux of the LEDs.", "", "luminance", "ratio", "ratio-maps"},
      common_scale_of(ratios), data);
  html += relation_group(differences,
                         {"Difference of the luminance",
                          "Cell by cell, scaled to the LED flux of the first design; the middle of the colors is zero.",
                          luminance_unit, "difference", "difference", "difference-maps"},
                         balanced(differences), data);
  html += relation_group(densities,
                         {"Difference of the density", "The middle of the colors is zero.", "", "difference",
                          "density difference", "density-difference-maps"},
                         balanced(densities), data);
  return html + unrelated(reports);
}

}  // namespace evenglow::design
