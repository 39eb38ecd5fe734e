#pragma once

#include <string>

#include "tests/support/scenes.h"

namespace evenglow::tests {

/// The next-event estimate of the luminance against plain counting, in runs of their own.
struct EstimatorComparison {
  double z_mean = 0.0;  ///< of the difference of the mean luminances
  double chi2 = 0.0;    ///< over the cells
  double chance = 0.0;  ///< of a larger one
  int cells = 0;
  double se_mean = 0.0;  ///< relative standard error of the difference
};

/// `next_receiver`, `count_receiver`: keys of the luminance receiver besides the estimator. `estimator`: of the first.
EstimatorComparison compare_estimators(const std::string& backlight, const std::string& next_receiver,
                                       const std::string& count_receiver, const TraceSetup& next,
                                       const TraceSetup& count, const char* estimator = "next_event");

}  // namespace evenglow::tests
