#include "design/report/report_curves.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace evenglow::design {
namespace {

std::string curve_name(const std::vector<const Report*>& reports, std::size_t i, const std::string& name) {
  return reports.size() == 1 ? name : reports[i]->variant + (name.empty() ? "" : ", " + name);
}

Ink curve_ink(const std::vector<const Report*>& reports, std::size_t i, std::size_t alone) {
  return series_ink(reports.size() == 1 ? alone : i);
}

using StepValue = std::function<core::Estimate(const StepRecord&)>;

Curve by_step(const Report& report, const StepValue& value) {
  Curve curve;
  for (const StepRecord& step : report.steps) {
    const core::Estimate estimate = value(step);
    curve.x.push_back(step.step);
    curve.y.push_back(100.0 * estimate.value);
    curve.se.push_back(100.0 * estimate.se);
  }
  return curve;
}

Curve final_point(const Report& report, const core::Estimate& value) {
  Curve curve;
  curve.x = {report.steps.empty() ? 0.0 : report.steps.back().step};
  curve.y = {100.0 * value.value};
  curve.se = {100.0 * value.se};
  curve.joined = false;
  curve.shape = Mark::diamond;
  return curve;
}

void add_noise(const Report& report, CurvePlot& plot) {
  const auto has_noise = [](const StepRecord& s) { return s.noise > 0.0; };
  if (std::none_of(report.steps.begin(), report.steps.end(), has_noise)) return;
  Curve noise = by_step(report, [](const StepRecord& s) { return core::Estimate{s.noise, 0.0}; });
  noise.name = "noise";
  noise.ink = Ink::series_3;
  noise.dashed = true;
  noise.marked = false;
  plot.curves.push_back(std::move(noise));
}

}  // namespace

CurvePlot rms_plot(const std::vector<const Report*>& reports) {
  CurvePlot plot{"Evenness", "step", "RMS non-uniformity (%)", true, true, false, {}};
  for (std::size_t i = 0; i < reports.size(); ++i) {
    Curve raw = by_step(*reports[i], [](const StepRecord& s) { return core::Estimate{s.rms, 0.0}; });
    raw.name = curve_name(reports, i, "raw");
    raw.ink = reports.size() == 1 ? Ink::muted : series_ink(i);
    raw.dashed = true;
    raw.marked = reports.size() == 1;
    raw.shape = Mark::ring;
    Curve corrected = by_step(*reports[i], [](const StepRecord& s) { return s.rms_corrected; });
    corrected.name = curve_name(reports, i, reports.size() == 1 ? "noise taken off" : "");
    corrected.ink = curve_ink(reports, i, 0);
    Curve judged = final_point(*reports[i], reports[i]->final.rms_corrected);
    judged.name = curve_name(reports, i, "final trace");
    judged.ink = curve_ink(reports, i, 1);
    raw.in_legend = judged.in_legend = reports.size() == 1;
    for (Curve* curve : {&raw, &corrected, &judged}) plot.curves.push_back(*curve);
  }
  if (reports.size() == 1) add_noise(*reports.front(), plot);
  return plot;
}

CurvePlot efficiency_plot(const std::vector<const Report*>& reports) {
  CurvePlot plot{"Efficiency", "step", "LED flux that leaves the top (%)", false, true, false, {}};
  for (std::size_t i = 0; i < reports.size(); ++i) {
    Curve curve = by_step(*reports[i], [](const StepRecord& s) { return s.efficiency; });
    curve.name = curve_name(reports, i, reports.size() == 1 ? "by step" : "");
    curve.ink = curve_ink(reports, i, 0);
    Curve judged = final_point(*reports[i], reports[i]->final.efficiency);
    judged.name = curve_name(reports, i, "final trace");
    judged.ink = curve_ink(reports, i, 1);
    judged.in_legend = reports.size() == 1;
    plot.curves.push_back(curve);
    plot.curves.push_back(judged);
  }
  return plot;
}

core::Estimate luminance_towards(const AngularLuminance& angular, std::size_t polar, double azimuth_deg) {
  const int count = angular.azimuth_count;
  const double place = azimuth_deg / 360.0 * count;
  const int bin = static_cast<int>(std::floor(place)) % count;
  const auto value = [&](int azimuth) {
    return angular.luminance[polar * static_cast<std::size_t>(count) + static_cast<std::size_t>(azimuth)];
  };
  if (place != std::floor(place) || count == 1) return value(bin);
  const core::Estimate a = value(bin);
  const core::Estimate b = value((bin + count - 1) % count);
  return {0.5 * (a.value + b.value), 0.5 * std::hypot(a.se, b.se)};
}

CurvePlot angular_section(const std::vector<const Report*>& reports, SectionDirection direction) {
  const bool along_x = direction == SectionDirection::along_x;
  const double azimuth = along_x ? 0.0 : 90.0;
  CurvePlot plot{along_x ? "In the plane of x" : "In the plane of y",
                 "angle of view (\u00b0)",
                 "luminance (cd/m\u00b2)",
                 false,
                 false,
                 true,
                 {}};
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (!reports[i]->angular) continue;
    const AngularLuminance& angular = *reports[i]->angular;
    Curve curve;
    curve.marked = false;
    curve.name = curve_name(reports, i, reports.size() == 1 ? "final" : "");
    curve.ink = series_ink(i);
    const auto add = [&](std::size_t polar, double side) {
      const core::Estimate value = luminance_towards(angular, polar, side > 0 ? azimuth : azimuth + 180.0);
      curve.x.push_back(side * 0.5 * (angular.polar_deg[polar] + angular.polar_deg[polar + 1]));
      curve.y.push_back(value.value);
      curve.se.push_back(value.se);
    };
    const std::size_t bins = angular.polar_deg.empty() ? 0 : angular.polar_deg.size() - 1;
    for (std::size_t p = bins; p-- > 0;) add(p, -1.0);
    for (std::size_t p = 0; p < bins; ++p) add(p, 1.0);
    plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace evenglow::design
