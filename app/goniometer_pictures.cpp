#include "app/goniometer_pictures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/units.h"
#include "design/report/cairo_drawing.h"
#include "design/report/curve_plot.h"

namespace evenglow::app {
namespace {

using design::Box;
using design::CairoDrawing;
using design::Curve;
using design::CurvePlot;
using design::Mark;
using tracer::GoniometerResult;
using tracer::GoniometerRow;
using tracer::GoniometerSpec;
using tracer::ScatterKind;

constexpr double kText = 20.0, kPanel = 700.0, kHeight = 700.0, kHead = 90.0;
constexpr std::size_t kMostPanels = 3;

double degrees(double rad) {
  return rad / core::kRadPerDeg;
}

const char* name_of(ScatterKind kind) {
  return kind == ScatterKind::reflection ? "Reflection" : "Transmission";
}

/// The box of panel `i` of a row of panels below the heading.
Box panel(std::size_t i) {
  return {20.0 + kPanel * static_cast<double>(i), kHead, kPanel - 50.0, kHeight - kHead - 20.0};
}

/// A picture with room for a row of panels, two at least.
class Sheet {
 public:
  Sheet(std::size_t panels, const std::string& heading, const std::string& legend)
      : drawing(static_cast<int>(kPanel * static_cast<double>(std::max<std::size_t>(panels, 2))),
                static_cast<int>(kHeight)) {
    drawing.text({20, 36}, heading, {1.2 * kText, design::Align::left, design::Ink::text, true, false});
    drawing.text({20, 68}, legend, {0.85 * kText, design::Align::left, design::Ink::muted, false, false});
  }

  CairoDrawing drawing;
};

CurvePlot bsdf_plot(const GoniometerSpec& spec, ScatterKind kind) {
  CurvePlot plot;
  plot.title = name_of(kind);
  plot.x_label = "theta from the axis (degrees)";
  plot.y_label = "BSDF (1/sr)";
  plot.log_y = true;
  const double last = std::min(70.0, 89.0 - degrees(spec.sigma));
  for (std::size_t i = 0; i < 4; ++i) {
    const double angle = 45.0 * static_cast<double>(i);
    Curve curve;
    curve.name = fmt::format("{:g}°", angle);
    curve.ink = design::series_ink(i);
    curve.marked = false;
    curve.dashed = i == 3;
    for (double theta = 0.0; theta <= last; theta += 0.5) {
      curve.x.push_back(theta);
      curve.y.push_back(
          filtered_bsdf(spec, kind, spec.psi.front(), angle * core::kRadPerDeg, theta * core::kRadPerDeg));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

void write_bsdf(const GoniometerSpec& spec, const std::filesystem::path& path) {
  Sheet sheet(2, "BSDF behind a polarizer at four angles",
              fmt::format("film at psi = {:g}°, incidence {:g}°; angle of the polarizer from the plane of incidence",
                          degrees(spec.psi.front()), degrees(spec.sigma)));
  draw_curves(sheet.drawing, bsdf_plot(spec, ScatterKind::reflection), panel(0), kText, true);
  draw_curves(sheet.drawing, bsdf_plot(spec, ScatterKind::transmission), panel(1), kText, true);
  sheet.drawing.save(path);
}

/// One illumination of one panel: line film, discs measured, rings traced, dashes published.
void add_curves(const std::vector<const GoniometerRow*>& rows, design::Ink ink, bool traced, CurvePlot& plot) {
  Curve film, measured, photons, published;
  film.name = illumination_name(rows.front()->setting);
  film.marked = false;
  published.marked = false;
  published.dashed = true;
  measured.joined = photons.joined = false;
  photons.shape = Mark::ring;
  for (Curve* curve : {&film, &measured, &photons, &published}) curve->ink = ink;
  measured.in_legend = photons.in_legend = published.in_legend = false;
  for (const GoniometerRow* row : rows) {
    const double theta = degrees(row->setting.theta);
    const auto add = [&](Curve& curve, double value) {
      if (value <= 0.0) return;
      curve.x.push_back(theta);
      curve.y.push_back(value);
    };
    add(film, row->film);
    add(measured, row->setting.measured);
    add(published, row->setting.published);
    if (!traced || row->traced.value <= 0.0) continue;
    add(photons, row->traced.value);
    photons.se.push_back(row->traced.se);
  }
  for (Curve* curve : {&published, &film, &photons, &measured}) {
    if (!curve->x.empty()) plot.curves.push_back(std::move(*curve));
  }
}

CurvePlot luminance_plot(const GoniometerSpec& spec, const GoniometerResult& result, ScatterKind kind, double psi) {
  CurvePlot plot;
  plot.title = fmt::format("psi = {:g}°", degrees(psi));
  plot.x_label = "theta from the axis (degrees)";
  plot.y_label = "luminance (cd/m²)";
  plot.log_y = true;
  const std::size_t shown = std::min<std::size_t>(spec.filter.angles.size() + 1, 6);
  for (std::size_t i = 0; i < shown; ++i) {
    std::vector<const GoniometerRow*> rows;
    for (const GoniometerRow& row : result.rows) {
      const bool same =
          i == 0 ? !row.setting.filtered : row.setting.filtered && row.setting.filter == spec.filter.angles[i - 1];
      if (row.kind == kind && row.setting.psi == psi && same) rows.push_back(&row);
    }
    if (!rows.empty()) add_curves(rows, design::series_ink(i), result.photons > 0, plot);
  }
  return plot;
}

void write_luminance(const GoniometerSpec& spec, const GoniometerResult& result, ScatterKind kind,
                     const std::filesystem::path& path) {
  const std::size_t panels = std::min(spec.psi.size(), kMostPanels);
  Sheet sheet(panels, std::string(name_of(kind)) + ": luminance against the angle of observation",
              "lines: film evaluated; discs: measured; rings with bars: traced ± 1 standard error; dashes: "
              "published simulation");
  for (std::size_t i = 0; i < panels; ++i) {
    draw_curves(sheet.drawing, luminance_plot(spec, result, kind, spec.psi[i]), panel(i), kText, true);
  }
  sheet.drawing.save(path);
}

}  // namespace

void write_goniometer_pictures(const GoniometerSpec& spec, const GoniometerResult& result,
                               const std::filesystem::path& directory) {
  write_bsdf(spec, directory / "bsdf.png");
  write_luminance(spec, result, ScatterKind::reflection, directory / "reflection.png");
  write_luminance(spec, result, ScatterKind::transmission, directory / "transmission.png");
}

}  // namespace evenglow::app
