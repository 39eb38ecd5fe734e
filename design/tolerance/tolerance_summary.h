#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/tolerance/half_traces.h"
#include "design/tolerance/map_sums.h"
#include "design/tolerance/population.h"
#include "design/tolerance/sensitivity.h"
#include "design/tolerance/tolerance_spec.h"
#include "design/tolerance/yield.h"

namespace evenglow::design {

/// What was traced of one sample.
struct SampleResult {
  std::vector<double> parameters;       ///< as `parameter_names`
  std::vector<core::Estimate> figures;  ///< as `kFigures`
  HalfTraces halves{};
};

/// The samples of a tolerance run and the design that they vary about.
struct ToleranceSamples {
  std::vector<core::Estimate> reference;  ///< figures of the nominal design, from many photons
  std::vector<SampleResult> samples;      ///< the first is sample 1
  MapSums maps;
};

/// One figure over all samples.
struct FigureSummary {
  Population population;
  core::Estimate shift;           ///< what noise adds to the mean; taken off `corrected` (0 but for uniformities)
  std::vector<double> corrected;  ///< of each sample, noise taken off
  std::optional<Sensitivity> sensitivity;
};

struct ToleranceSummary {
  std::vector<FigureSummary> figures;  ///< as `kFigures`
  std::vector<Yield> yields;           ///< of each limit
  std::optional<Yield> all;            ///< of all limits together; none without limits
  std::vector<int> worst;              ///< numbers of the samples (from 1), the worst first
};

/// The samples are ranked by how far they keep (or miss) their tightest limit, in standard deviations of the figure as
/// seen; without limits by their RMS. The noise of a sample, for its nearness to a limit, is that of all on average.
ToleranceSummary summarize(const ToleranceSpec& spec, const ToleranceSamples& run);

}  // namespace evenglow::design
