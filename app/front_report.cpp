#include "app/front_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "design/report/csv_writer.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/text_escape.h"

namespace evenglow::app {
namespace {

using design::FrontPoint;
using Json = nlohmann::ordered_json;

design::Curve curve(const std::string& name, design::Ink ink) {
  design::Curve result;
  result.name = name;
  result.ink = ink;
  return result;
}

std::string color_text(const FrontPoint& point) {
  if (!point.color) return "-";
  return design::measured(*point.color) + (point.breaks_color ? " BREAKS THE BOUND" : "");
}

design::CurvePlot front_plot(const std::vector<FrontPoint>& points) {
  design::CurvePlot plot{
      "Evenness against efficiency", "efficiency (%)", "RMS non-uniformity (%)", false, false, true, {}};
  design::Curve all = curve("all levels", design::Ink::series_1);
  design::Curve front = curve("front", design::Ink::series_2);
  front.joined = false;
  front.shape = design::Mark::diamond;
  const std::vector<bool> kept = on_front(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& judged = points[i].judged;
    for (design::Curve* c : {&all, &front}) {
      if (c == &front && !kept[i]) continue;
      c->x.push_back(100.0 * judged.efficiency.value);
      c->y.push_back(100.0 * judged.rms_corrected.value);
      c->se.push_back(100.0 * judged.rms_corrected.se);
    }
  }
  plot.curves = {all, front};
  return plot;
}

design::CurvePlot level_plot(const std::vector<FrontPoint>& points, bool rms) {
  design::CurvePlot plot{rms ? "Evenness against the level" : "Efficiency against the level",
                         "mean density",
                         rms ? "RMS non-uniformity (%)" : "efficiency (%)",
                         false,
                         false,
                         rms,
                         {}};
  design::Curve c = curve(rms ? "RMS, noise taken off" : "efficiency", design::Ink::series_1);
  for (const FrontPoint& point : points) {
    const core::Estimate value = rms ? point.judged.rms_corrected : point.judged.efficiency;
    c.x.push_back(point.level);
    c.y.push_back(100.0 * value.value);
    c.se.push_back(100.0 * value.se);
  }
  plot.curves = {c};
  return plot;
}

std::string front_csv(const std::vector<FrontPoint>& points) {
  std::string text =
      "point,level,mean_density,rms_corrected,rms_corrected_se,rms_95_low,rms_95_high,efficiency,efficiency_se,"
      "luminance_mean_cd_m2,luminance_mean_se,color_rms,color_rms_se,breaks_color,on_front,held_low,held_high,steps,"
      "photons,cpu_s,stop_reason\n";
  const std::vector<bool> kept = on_front(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FrontPoint& p = points[i];
    text += std::to_string(i + 1);
    for (const double value : {p.level, p.density.mean(), p.judged.rms_corrected.value, p.judged.rms_corrected.se,
                               p.judged.rms_low, p.judged.rms_high, p.judged.efficiency.value, p.judged.efficiency.se,
                               p.judged.luminance_mean.value, p.judged.luminance_mean.se}) {
      text += ',' + design::shortest(value);
    }
    text += p.color ? ',' + design::shortest(p.color->value) + ',' + design::shortest(p.color->se) : ",,";
    text += fmt::format(",{},{},{},{},{},{},{},{}\n", p.breaks_color ? 1 : 0, kept[i] ? 1 : 0, p.held_low, p.held_high,
                        p.steps, p.photons, design::shortest(p.cpu_s), design::csv_field(p.stop_reason));
  }
  return text;
}

Json front_json(const design::Study& study, const Run& run, const std::vector<FrontPoint>& points) {
  const std::vector<bool> kept = on_front(points);
  Json rows = Json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FrontPoint& p = points[i];
    rows.push_back({{"level", p.level},
                    {"mean_density", p.density.mean()},
                    {"rms_corrected", p.judged.rms_corrected.value},
                    {"rms_corrected_se", p.judged.rms_corrected.se},
                    {"rms_95_low", p.judged.rms_low},
                    {"rms_95_high", p.judged.rms_high},
                    {"efficiency", p.judged.efficiency.value},
                    {"efficiency_se", p.judged.efficiency.se},
                    {"luminance_mean_cd_m2", p.judged.luminance_mean.value},
                    {"luminance_mean_se", p.judged.luminance_mean.se},
                    {"uniformity_9", p.judged.uniformity_9},
                    {"uniformity_13", p.judged.uniformity_13},
                    {"color_rms", p.color ? Json(p.color->value) : Json(nullptr)},
                    {"color_rms_se", p.color ? Json(p.color->se) : Json(nullptr)},
                    {"breaks_color", p.breaks_color},
                    {"on_front", static_cast<bool>(kept[i])},
                    {"held_low", p.held_low},
                    {"held_high", p.held_high},
                    {"steps", p.steps},
                    {"photons", p.photons},
                    {"stop_reason", p.stop_reason},
                    {"density", fmt::format("density_{:02}.csv", i + 1)}});
  }
  Json timing = Json::array();
  for (const FrontPoint& p : points) timing.push_back(p.cpu_s);
  return {{"format", "evenglow-pareto/1"}, {"version", study.version},   {"title", run.title},
          {"command", study.command},      {"overrides", run.overrides}, {"seed", run.trace.seed},
          {"points", std::move(rows)},     {"cpu_s", std::move(timing)}};
}

/// What an earlier front of more points has left: nobody may take it for a part of this one.
void remove_points_from(std::size_t number, const std::filesystem::path& directory) {
  std::error_code ignored;
  for (bool found = true; found; ++number) {
    found = false;
    for (const char* name : {"density", "luminance"})
      found = std::filesystem::remove(directory / fmt::format("{}_{:02}.csv", name, number), ignored) || found;
  }
}

}  // namespace

design::Study front_study(const Run& run, const std::string& command, const std::vector<FrontPoint>& points) {
  design::Study study;
  study.title = run.title + ": evenness against efficiency";
  study.version = core::version();
  study.command = command;
  study.run_file = run.file_text;
  study.lead =
      "A design at each level (mean density) of the microstructure, each judged by a trace of its own with fresh "
      "random "
      "numbers; bars are standard errors, the Monte Carlo noise is taken off the RMS. Points of the front are those "
      "that "
      "no other one beats: by more than two standard errors in one figure, and not worse by as much in the other.";
  study.columns = {"point", "level",      "RMS (%)", "95 %",    "efficiency (%)", "luminance (cd/m\u00b2)",
                   "front", "cells held", "steps",   "photons", "CPU s"};
  const bool colored =
      std::any_of(points.begin(), points.end(), [](const FrontPoint& p) { return p.color.has_value(); });
  if (colored) study.columns.push_back("color RMS (u', v')");
  const std::vector<bool> kept = on_front(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FrontPoint& p = points[i];
    study.rows.push_back(
        {std::to_string(i + 1), fmt::format("{:.4f}", p.level), design::measured(p.judged.rms_corrected, 100.0),
         fmt::format("{:.2f} to {:.2f}", 100.0 * p.judged.rms_low, 100.0 * p.judged.rms_high),
         design::measured(p.judged.efficiency, 100.0), design::measured(p.judged.luminance_mean), kept[i] ? "yes" : "",
         fmt::format("{} low, {} high", p.held_low, p.held_high), std::to_string(p.steps),
         fmt::format("{:.3g}", static_cast<double>(p.photons)), fmt::format("{:.3g}", p.cpu_s)});
    if (colored) study.rows.back().push_back(color_text(p));
    study.densities.push_back({fmt::format("Level {:.4f}", p.level),
                               fmt::format("RMS {} %, efficiency {} %", design::measured(p.judged.rms_corrected, 100.0),
                                           design::measured(p.judged.efficiency, 100.0)),
                               p.density});
  }
  study.plots = {front_plot(points), level_plot(points, true), level_plot(points, false)};
  return study;
}

void write_front(const design::Study& study, const Run& run, const std::vector<FrontPoint>& points,
                 const std::filesystem::path& directory) {
  design::write_file(directory / "pareto.csv", front_csv(points));
  design::write_file(directory / "pareto.json",
                     front_json(study, run, points).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  design::write_file(directory / "pareto.html", design::study_html(study));
  design::write_study_png(study, directory / "pareto.png");
  for (std::size_t i = 0; i < points.size(); ++i) {
    design::write_file(
        directory / fmt::format("density_{:02}.csv", i + 1),
        design::matrix_csv(points[i].density, "density of the microstructure (share of the cell's area, 1)"));
    design::write_file(directory / fmt::format("luminance_{:02}.csv", i + 1),
                       design::matrix_csv(points[i].luminance, "luminance (cd/m2)"));
  }
  remove_points_from(points.size() + 1, directory);
}

}  // namespace evenglow::app
