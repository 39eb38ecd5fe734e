#include "app/sweep_picture.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "app/sweep_options.h"
#include "core/base/units.h"
#include "design/report/cairo_drawing.h"
#include "design/report/curve_plot.h"

namespace evenglow::app {
namespace {

using design::Curve;
using design::CurvePlot;
using tracer::SweepRow;

constexpr double kText = 18.0, kPanel = 700.0, kHeight = 620.0, kHead = 90.0;

/// A column that the rows were swept over.
struct Axis {
  double SweepRow::*value;
  double unit;
  const char* label;
  const char* unit_name;
};
constexpr Axis kAxes[] = {{&SweepRow::sigma, core::kRadPerDeg, "angle of incidence (degrees)", "°"},
                          {&SweepRow::azimuth, core::kRadPerDeg, "azimuth (degrees)", "°"},
                          {&SweepRow::wavelength, 1.0, "wavelength (nm)", " nm"}};

std::size_t swept_axis(const std::vector<SweepRow>& rows) {
  std::size_t best = 0, most = 0;
  for (std::size_t a = 0; a < std::size(kAxes); ++a) {
    std::set<double> values;
    for (const SweepRow& row : rows) values.insert(row.*kAxes[a].value);
    if (values.size() > most) {
      most = values.size();
      best = a;
    }
  }
  return best;
}

/// Rows with the first values of all axes but `swept`.
std::vector<SweepRow> shown_rows(const std::vector<SweepRow>& rows, std::size_t swept) {
  std::vector<SweepRow> shown;
  for (const SweepRow& row : rows) {
    const bool same = std::all_of(std::begin(kAxes), std::end(kAxes), [&](const Axis& axis) {
      return axis.value == kAxes[swept].value || row.*axis.value == rows.front().*axis.value;
    });
    if (same) shown.push_back(row);
  }
  return shown;
}

struct Panel {
  const char* label;
  core::Estimate SweepRow::*total;
  core::Estimate SweepRow::*specular;
};

/// Some light goes straight on or is mirrored, some is scattered.
bool has_two_parts(const std::vector<SweepRow>& rows) {
  const auto any = [&](auto&& part) { return std::any_of(rows.begin(), rows.end(), part); };
  return any([](const SweepRow& r) { return r.specular_transmittance.value + r.specular_reflectance.value > 0.0; }) &&
         any([](const SweepRow& r) { return r.scattered_transmittance.value + r.scattered_reflectance.value > 0.0; });
}

CurvePlot plot_of(const std::vector<SweepRow>& rows, const Axis& axis, const Panel& panel) {
  CurvePlot plot;
  plot.x_label = axis.label;
  plot.y_label = panel.label;
  plot.from_zero = true;
  const bool both = has_two_parts(rows);
  std::size_t ink = 0;
  std::vector<tracer::SweepLight> done;
  for (const SweepRow& first : rows) {
    if (std::find(done.begin(), done.end(), first.light) != done.end()) continue;
    done.push_back(first.light);
    Curve total, specular;
    total.name = name_of(first.light);
    total.marked = specular.marked = specular.in_legend = false;
    specular.dashed = true;
    total.ink = specular.ink = design::series_ink(ink++);
    for (const SweepRow& row : rows) {
      if (row.light != first.light) continue;
      total.x.push_back(row.*axis.value / axis.unit);
      total.y.push_back((row.*panel.total).value);
      total.se.push_back((row.*panel.total).se);
      specular.x.push_back(total.x.back());
      specular.y.push_back((row.*panel.specular).value);
    }
    total.marked = total.x.size() == 1;
    plot.curves.push_back(std::move(total));
    if (both) plot.curves.push_back(std::move(specular));
  }
  return plot;
}

}  // namespace

void write_sweep_picture(const std::vector<SweepRow>& rows, const std::string& heading,
                         const std::filesystem::path& path) {
  const std::size_t swept = swept_axis(rows);
  const auto shown = shown_rows(rows, swept);
  std::string legend = "curves: polarization of the incident light; ";
  if (has_two_parts(shown)) legend += "dashes: specular part; ";
  for (std::size_t a = 0; a < std::size(kAxes); ++a) {
    if (a == swept) continue;
    legend += fmt::format(" {} {:.5g}{}",
                          a == 0   ? "incidence"
                          : a == 1 ? "azimuth"
                                   : "wavelength",
                          shown.front().*kAxes[a].value / kAxes[a].unit, kAxes[a].unit_name);
  }
  design::CairoDrawing drawing(static_cast<int>(2 * kPanel), static_cast<int>(kHeight));
  const design::TextStyle head{1.2 * kText, design::Align::left, design::Ink::text, true, false};
  drawing.text({20, 36}, design::fitted(drawing, heading, head, 2 * kPanel - 40), head);
  drawing.text({20, 68}, legend, {0.85 * kText, design::Align::left, design::Ink::muted, false, false});
  const Panel panels[] = {
      {"transmittance (share of the incident light)", &SweepRow::transmittance, &SweepRow::specular_transmittance},
      {"reflectance (share of the incident light)", &SweepRow::reflectance, &SweepRow::specular_reflectance}};
  for (std::size_t i = 0; i < 2; ++i) {
    const design::Box box{20.0 + kPanel * static_cast<double>(i), kHead, kPanel - 50.0, kHeight - kHead - 20.0};
    draw_curves(drawing, plot_of(shown, kAxes[swept], panels[i]), box, kText, true);
  }
  drawing.save(path);
}

}  // namespace evenglow::app
