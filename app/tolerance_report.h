#pragma once

#include <filesystem>
#include <string>

#include "app/tolerance_job.h"
#include "design/report/study.h"
#include "design/tolerance/tolerance_summary.h"

namespace evenglow::app {

/// Cells over which the variances of the maps are smoothed.
inline constexpr double kMapSmoothing = 2.0;

/// All that the reports of a tolerance run are made of.
struct ToleranceOutcome {
  const ToleranceJob& job;
  const design::ToleranceSamples& run;
  const design::ToleranceSummary& summary;
  std::string command;  ///< repeats it

  const design::ToleranceSpec& spec() const { return job.nominal.tolerance; }
};

/// The table of the figures and the histograms, for stdout and the picture.
design::Study tolerance_study(const ToleranceOutcome& outcome);

/// A row for each limit, and one for all together: as traced, without noise, what noise may flip.
std::vector<std::string> yield_columns();
std::vector<std::vector<std::string>> yield_rows(const ToleranceOutcome& outcome);

/// tolerance.csv: a row for each sample with its parameters, figures and their standard errors.
std::string tolerance_csv(const ToleranceOutcome& outcome);
std::string tolerance_json(const ToleranceOutcome& outcome);
/// The page (tolerance_page.cpp).
std::string tolerance_html(const ToleranceOutcome& outcome);

/// tolerance.csv, .json, .html, .png, luminance_mean.csv and luminance_spread.csv.
void write_tolerance(const ToleranceOutcome& outcome, const std::filesystem::path& directory);

}  // namespace evenglow::app
