#pragma once

#include <cstddef>
#include <vector>

#include "core/math/cell_field.h"

namespace evenglow::design {

/// The values that a color bar or an axis spans.
struct ValueScale {
  double low = 0.0;
  double high = 1.0;

  /// 0 at `low`, 1 at `high`; not a number stays so.
  double share(double value) const { return (value - low) / (high - low); }
};

/// Has the field a value for each cell?
bool is_filled(const core::CellField& field);

/// Statistics of the finite values of a field; all zero if there is none.
struct FieldSummary {
  double mean = 0.0;
  double min = 0.0;
  double max = 0.0;
  std::size_t count = 0;
};
FieldSummary summarize(const core::CellField& field);

/// From the least to the greatest finite value of all fields; widened a little if they are all equal, 0 to 1 if none.
ValueScale common_scale(const std::vector<const core::CellField*>& fields);

}  // namespace evenglow::design
