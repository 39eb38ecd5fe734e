#pragma once

#include <optional>
#include <vector>

#include "core/montecarlo/estimate.h"
#include "design/tolerance/tolerance_spec.h"

namespace evenglow::design {

/// A share with its 95 % confidence interval.
struct Share {
  double value = 0.0;
  double low = 0.0;
  double high = 1.0;
};

/// Share of successes among n trials with the interval of Wilson (J. Am. Stat. Assoc. 22, 1927) at 95 %, which never
/// leaves [0, 1] and is no point where all or none pass. `successes` in [0, n], n >= 1.
Share wilson(double successes, double n);

/// How many samples keep a limit.
struct Yield {
  Share seen;          ///< as traced, noise included
  Share corrected;     ///< of the samples without noise (`without_noise`)
  int passed = 0;      ///< as traced
  int near_limit = 0;  ///< whose figure lies within two standard errors of a limit that decides: noise may flip them
  double least = 0.0;  ///< share if all of these fail
  double most = 0.0;   ///< share if all of these pass
};

/// One limit as the samples see it: as traced, and without noise.
struct LimitedFigure {
  Limit limit;
  std::vector<core::Estimate> seen;
  std::vector<double> corrected;
  double shift = 0.0;  ///< of the values by their noise, on average
};

/// The yield against all of these together; at least one, all of as many samples.
Yield yield_of(const std::vector<LimitedFigure>& figures);

/// Does the value keep the limit?
bool keeps(const Limit& limit, double value);

}  // namespace evenglow::design
