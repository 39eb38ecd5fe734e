#include "design/report/histogram_plot.h"

#include <algorithm>
#include <cmath>

#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

struct Sample {
  Curve curve;                 ///< name and looks
  std::vector<double> values;  ///< mean 1, ascending
};

/// Values over their mean; cells with a target of zero do not count.
std::vector<double> relative(const core::CellField& field, const core::CellField& target) {
  const bool masked = is_filled(target) && target.grid == field.grid;
  std::vector<double> values;
  double sum = 0.0;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (!std::isfinite(field.values[i]) || (masked && !(target.values[i] > 0.0))) continue;
    values.push_back(field.values[i]);
    sum += field.values[i];
  }
  if (!(sum > 0.0)) return {};
  for (double& value : values) value *= static_cast<double>(values.size()) / sum;
  std::sort(values.begin(), values.end());
  return values;
}

void add(std::vector<Sample>& samples, Curve curve, const core::CellField& field, const core::CellField& target) {
  if (!is_filled(field)) return;
  curve.marked = false;
  curve.stepped = true;
  std::vector<double> values = relative(field, target);
  if (!values.empty()) samples.push_back({std::move(curve), std::move(values)});
}

Curve looks(std::string name, Ink ink, bool dashed) {
  Curve curve;
  curve.name = std::move(name);
  curve.ink = ink;
  curve.dashed = dashed;
  return curve;
}

std::vector<Sample> samples_of(const std::vector<const Report*>& reports) {
  std::vector<Sample> samples;
  const bool alone = reports.size() == 1;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Report& r = *reports[i];
    if (alone && r.steps.size() > 1) add(samples, looks("start", Ink::muted, true), r.start_luminance, r.target);
    if (alone) add(samples, looks("target", Ink::series_3, true), r.target, r.target);
    add(samples, looks(alone ? "final" : r.variant, series_ink(i), false), r.luminance, r.target);
  }
  return samples;
}

/// A multiple of the width so that the least value lies in the first bin.
struct Bins {
  double low = 0.0;
  double width = 1.0;
  std::size_t count = 1;
};

Bins bins_of(const std::vector<Sample>& samples) {
  double low = samples.front().values.front();
  double high = samples.front().values.back();
  double width = 0.0;
  for (const Sample& sample : samples) {
    const std::vector<double>& v = sample.values;
    low = std::min(low, v.front());
    high = std::max(high, v.back());
    const double spread = v[v.size() * 3 / 4] - v[v.size() / 4];
    const double own = 2.0 * spread / std::cbrt(static_cast<double>(v.size()));
    if (own > 0.0) width = width > 0.0 ? std::min(width, own) : own;
  }
  const double range = std::max(high - low, 1e-6);
  width = std::clamp(width, range / 60.0, range / 8.0);
  const auto count = static_cast<std::size_t>(std::ceil(range / width * (1.0 + 1e-12)));
  return {low, range / static_cast<double>(count), count};
}

Curve counted(const Sample& sample, const Bins& bins) {
  Curve curve = sample.curve;
  curve.y.assign(bins.count, 0.0);
  for (const double value : sample.values) {
    const auto bin = static_cast<std::size_t>(std::max(0.0, (value - bins.low) / bins.width));
    curve.y[std::min(bin, bins.count - 1)] += 100.0 / static_cast<double>(sample.values.size());
  }
  for (std::size_t i = 0; i < bins.count; ++i)
    curve.x.push_back(bins.low + (static_cast<double>(i) + 0.5) * bins.width);
  return curve;
}

}  // namespace

CurvePlot luminance_histogram(const std::vector<const Report*>& reports) {
  CurvePlot plot{"Histogram of the cells", "luminance over its mean", "cells (%)", false, false, true, {}};
  const std::vector<Sample> samples = samples_of(reports);
  if (samples.empty()) return plot;
  const Bins bins = bins_of(samples);
  for (const Sample& sample : samples) plot.curves.push_back(counted(sample, bins));
  return plot;
}

}  // namespace evenglow::design
