#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "core/montecarlo/estimate.h"

/// Optimization of a few scalars of the backlight, a design of the density within each evaluation.
namespace evenglow::design {

/// A scalar key of the run file and its range, in the unit of the file.
struct OuterVariable {
  std::string key;
  double low = 0.0;
  double high = 1.0;
  double start = 0.5;
  bool whole = false;  ///< counts: the value is rounded
};

struct OuterSpec {
  std::vector<OuterVariable> variables;
  std::string method = "cobyla";  ///< cobyla, bobyqa, sbplx
  int evaluations = 20;           ///< designs at most
  double photons = 0.0;           ///< of all designs; 0: not bounded
  double rms = 0.02;              ///< noise-corrected RMS that must not be passed
};

/// `optimize` (or `optimise`): a list of `{key: PATH, range: [low, high], start: VALUE, whole: true}`; `optimizer`: a
/// map of `method`, `evaluations`, `photons`, `rms`. No variables if the file has no list.
OuterSpec read_outer(const core::ConfigNode& root);

/// What a design at a point came to.
struct OuterResult {
  std::vector<double> values;  ///< of the variables, in their order
  core::Estimate efficiency;
  core::Estimate rms;
  std::uint64_t photons = 0;
  double cpu_s = 0.0;
};

/// A design at these values. Empty: interrupted.
using OuterModel = std::function<std::optional<OuterResult>(const std::vector<double>&)>;

/// What is minimized: minus the efficiency, plus a penalty of the RMS beyond its bound by more than a standard error:
/// an excess of the whole bound costs an efficiency of 0.5.
double outer_merit(const OuterResult& result, double rms_bound);

/// NLopt's COBYLA, BOBYQA or Sbplx (none uses derivatives) in variables scaled to [0, 1], from the start, with a first
/// step of a quarter of the range. Noise-aware: the designs share their random numbers (the model's business), and the
/// search ends when its steps have come below 1/50 of the ranges: noise hides what lies below. It begins with what is
/// `known`: the search is deterministic and is played again on those values, so that it goes on after an interruption
/// as if there had been none. Empty: interrupted, after `observer` was told of each new result.
std::optional<std::vector<OuterResult>> run_outer(const OuterModel& model, const OuterSpec& spec,
                                                  std::vector<OuterResult> known,
                                                  const std::function<void(const std::vector<OuterResult>&)>& observer);

/// Index of the best result that keeps the bound within a standard error; of the least merit if none does.
std::size_t best_of(const std::vector<OuterResult>& results, double rms_bound);

}  // namespace evenglow::design
