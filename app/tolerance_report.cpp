#include "app/tolerance_report.h"

#include <fmt/format.h>

#include "app/tolerance_plots.h"
#include "core/base/version.h"
#include "design/report/csv_writer.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/text_escape.h"

namespace evenglow::app {
namespace {

using design::FigureSummary;
using design::Limit;
using design::Share;
using design::Yield;

std::string bounds_of(const Limit& limit, const design::Figure& f) {
  std::string text;
  if (limit.min) text = "at least " + design::rounded(f.scale * *limit.min);
  if (limit.max) text += (text.empty() ? "at most " : ", at most ") + design::rounded(f.scale * *limit.max);
  return text + ' ' + f.unit;
}

std::vector<std::string> yield_row(const std::string& name, const std::string& bounds, const Yield& y,
                                   std::size_t samples) {
  const auto range = [](double low, double high) { return fmt::format("{:.1f} to {:.1f}", 100.0 * low, 100.0 * high); };
  return {name,
          bounds,
          fmt::format("{} of {}", y.passed, samples),
          fmt::format("{:.1f}", 100.0 * y.seen.value),
          range(y.seen.low, y.seen.high),
          fmt::format("{:.1f}", 100.0 * y.corrected.value),
          range(y.corrected.low, y.corrected.high),
          std::to_string(y.near_limit),
          range(y.least, y.most)};
}

}  // namespace

std::vector<std::string> yield_columns() {
  return {"limit",     "bound",        "kept by",
          "yield (%)", "95 %",         "noise taken off (%)",
          "95 %",      "near a limit", "if these all fail to all pass (%)"};
}

std::vector<std::vector<std::string>> yield_rows(const ToleranceOutcome& o) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < o.spec().limits.size(); ++i) {
    const Limit& limit = o.spec().limits[i];
    const design::Figure& f = design::kFigures[static_cast<std::size_t>(design::figure_index(limit.figure))];
    rows.push_back(yield_row(f.title, bounds_of(limit, f), o.summary.yields[i], o.run.samples.size()));
  }
  if (o.summary.all && rows.size() > 1)
    rows.push_back(yield_row("all limits", "", *o.summary.all, o.run.samples.size()));
  return rows;
}

design::Study tolerance_study(const ToleranceOutcome& o) {
  design::Study study;
  study.title = o.job.nominal.title + ": tolerance of production";
  study.version = core::version();
  study.command = o.command;
  study.run_file = o.job.nominal.file_text;
  study.columns = {"figure", "unit", "nominal", "mean", "spread", "95 %", "noise", "least", "median", "greatest"};
  for (const std::size_t i : figure_order(o.spec())) {
    const design::Figure& f = design::kFigures[i];
    const FigureSummary& s = o.summary.figures[i];
    const design::Population& p = s.population;
    study.rows.push_back({f.title, f.unit, design::measured(o.run.reference[i], f.scale),
                          design::measured(p.mean, f.scale), design::measured(p.spread, f.scale),
                          fmt::format("{} to {}", design::rounded(f.scale * p.spread_low, 3),
                                      design::rounded(f.scale * p.spread_high, 3)),
                          design::rounded(f.scale * p.noise, 3), design::rounded(f.scale * p.least),
                          design::rounded(f.scale * p.median), design::rounded(f.scale * p.greatest)});
    study.plots.push_back(figure_histogram(i, o.spec(), o.run, o.summary));
  }
  return study;
}

std::string tolerance_csv(const ToleranceOutcome& o) {
  std::string text = "sample";
  for (const std::string& name : design::parameter_names(o.spec())) text += ',' + design::csv_field(name);
  for (const design::Figure& f : design::kFigures) text += fmt::format(",{0},{0}_se", f.name);
  text += o.spec().limits.empty() ? "\n" : ",passes\n";
  for (std::size_t i = 0; i < o.run.samples.size(); ++i) {
    const design::SampleResult& s = o.run.samples[i];
    text += std::to_string(i + 1);
    for (const double value : s.parameters) text += ',' + design::shortest(value);
    for (const core::Estimate& e : s.figures) text += ',' + design::shortest(e.value) + ',' + design::shortest(e.se);
    bool passes = true;
    for (const Limit& limit : o.spec().limits)
      passes = passes && keeps(limit, s.figures[static_cast<std::size_t>(design::figure_index(limit.figure))].value);
    text += o.spec().limits.empty() ? "\n" : passes ? ",1\n" : ",0\n";
  }
  return text;
}

void write_tolerance(const ToleranceOutcome& o, const std::filesystem::path& directory) {
  design::write_file(directory / "tolerance.csv", tolerance_csv(o));
  design::write_file(directory / "tolerance.json", tolerance_json(o));
  design::write_file(directory / "tolerance.html", tolerance_html(o));
  design::write_study_png(tolerance_study(o), directory / "tolerance.png");
  const design::SpreadMaps maps = o.run.maps.maps(o.spec().common_numbers, kMapSmoothing);
  design::write_file(directory / "luminance_mean.csv",
                     design::matrix_csv(maps.mean, "mean luminance of the samples (cd/m2)"));
  design::write_file(
      directory / "luminance_spread.csv",
      design::matrix_csv(maps.deviation,
                         "standard deviation of the luminance over the samples, noise taken off (cd/m2)"));
}

}  // namespace evenglow::app
