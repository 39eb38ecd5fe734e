#include "app/tolerance_plots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace evenglow::app {
namespace {

using design::Curve;

struct Bins {
  double low = 0.0, width = 1.0;
  int count = 1;
};

Bins bins_of(std::vector<double> values, const std::vector<double>& others) {
  std::sort(values.begin(), values.end());
  double low = values.front(), high = values.back();
  for (const double value : others) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double range = std::max(high - low, 1e-9 * (1.0 + std::abs(high)));
  const double quartiles = values[values.size() * 3 / 4] - values[values.size() / 4];
  const double width =
      std::clamp(2.0 * quartiles / std::cbrt(static_cast<double>(values.size())), range / 40.0, range / 8.0);
  const int count = static_cast<int>(std::ceil(range / width * (1.0 + 1e-12)));
  return {low, range / count, count};
}

/// With an empty bin at either end, so that the steps come down to zero.
Curve counted(const std::string& name, const std::vector<double>& values, const Bins& bins) {
  Curve curve;
  curve.name = name;
  curve.stepped = true;
  curve.marked = false;
  curve.y.assign(static_cast<std::size_t>(bins.count) + 2, 0.0);
  for (int i = -1; i <= bins.count; ++i) curve.x.push_back(bins.low + (i + 0.5) * bins.width);
  for (const double value : values) {
    const int bin = std::clamp(static_cast<int>((value - bins.low) / bins.width), 0, bins.count - 1);
    curve.y[static_cast<std::size_t>(bin) + 1] += 100.0 / static_cast<double>(values.size());
  }
  return curve;
}

Curve upright(const std::string& name, double x, double top, design::Ink ink) {
  Curve curve;
  curve.name = name;
  curve.ink = ink;
  curve.marked = false;
  curve.dashed = true;
  curve.x = {x, x};
  curve.y = {0.0, top};
  return curve;
}

}  // namespace

std::vector<std::size_t> figure_order(const design::ToleranceSpec& spec) {
  std::vector<std::size_t> order;
  order.reserve(design::kFigures.size());
  for (const design::Limit& limit : spec.limits)
    order.push_back(static_cast<std::size_t>(design::figure_index(limit.figure)));
  for (std::size_t f = 0; f < design::kFigures.size(); ++f) {
    if (std::find(order.begin(), order.end(), f) == order.end()) order.push_back(f);
  }
  return order;
}

design::CurvePlot figure_histogram(std::size_t figure, const design::ToleranceSpec& spec,
                                   const design::ToleranceSamples& run, const design::ToleranceSummary& summary) {
  const design::Figure& f = design::kFigures[figure];
  std::vector<double> seen, corrected;
  for (const design::SampleResult& s : run.samples) seen.push_back(f.scale * s.figures[figure].value);
  for (const double value : summary.figures[figure].corrected) corrected.push_back(f.scale * value);
  const Bins bins = bins_of(seen, corrected);
  design::CurvePlot plot{std::string("Samples by ") + f.title,
                         fmt::format("{} ({})", f.title, f.unit),
                         "samples (%)",
                         false,
                         false,
                         true,
                         {}};
  Curve traced = counted("as traced", seen, bins), clean = counted("noise taken off", corrected, bins);
  traced.ink = design::Ink::muted;
  const double top =
      std::max(*std::max_element(traced.y.begin(), traced.y.end()), *std::max_element(clean.y.begin(), clean.y.end()));
  plot.curves = {traced, clean, upright("nominal", f.scale * run.reference[figure].value, top, design::Ink::series_3)};
  for (const design::Limit& limit : spec.limits) {
    if (limit.figure != f.name) continue;
    for (const auto& bound : {limit.min, limit.max}) {
      if (bound) plot.curves.push_back(upright("limit", f.scale * *bound, top, design::Ink::series_2));
    }
  }
  return plot;
}

}  // namespace evenglow::app
