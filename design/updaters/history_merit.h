#pragma once

#include <memory>
#include <vector>

#include "core/math/cell_field.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/target.h"

namespace evenglow::design {

/// Squared RMS of luminance over target as the histories of the newest trace give it, noise included, with its gradient
/// in x = ln density. With y = L / t over the n cells that count and u = y / mean y:
///
///     f = sum (u - 1)^2 / n        df/dy_i = 2 / (n mean y) (u_i - 1 - f)
///
/// and dy/dx by the score function (ArrivalRecords::gradient). To f is added (ln(mean density / level))^2, for f itself
/// hardly hears the level.
class HistoryMerit {
 public:
  /// `state`: a step with records; Error without.
  HistoryMerit(const DesignState& state, const DesignSpec& spec);

  struct Value {
    double merit = 0.0;
    core::CellField gradient;
    double effective_share = 0.0;  ///< photons that the trace is worth there, over its own
  };
  Value at(const tracer::DensityField& density) const;

 private:
  RecordedTrace trace_;
  std::vector<double> rest_;  ///< luminance a photon of the trace less that of its records, at the traced density
  std::vector<double> inverse_target_;  ///< 0 where a cell does not count
  double counted_ = 0.0;
  double level_ = 0.0;
};

}  // namespace evenglow::design
