#pragma once

#include <vector>

#include "design/report/curve_plot.h"
#include "design/report/report.h"

namespace evenglow::design {

/// How many cells (percent) have which luminance, its mean taken as 1. One report: also at the start of a design, and
/// the target's own shape where one other than uniform is given; cells that do not count (target 0) are left out then.
/// Several: each finally. All in the same bins, their number by the rule of Freedman and Diaconis (1981), 8 to 60.
CurvePlot luminance_histogram(const std::vector<const Report*>& reports);

}  // namespace evenglow::design
