#pragma once

#include <vector>

#include "design/report/curve_plot.h"
#include "design/tolerance/figures.h"
#include "design/tolerance/tolerance_summary.h"

namespace evenglow::app {

/// How many samples (percent) have which value of a figure: as traced, and without noise; the nominal design and the
/// limits as upright lines. Values in the unit for people. Bins by the rule of Freedman and Diaconis (1981) from the
/// samples as traced, 8 to 40.
design::CurvePlot figure_histogram(std::size_t figure, const design::ToleranceSpec& spec,
                                   const design::ToleranceSamples& run, const design::ToleranceSummary& summary);

/// The figures in the order in which they are shown: those with limits first.
std::vector<std::size_t> figure_order(const design::ToleranceSpec& spec);

}  // namespace evenglow::app
