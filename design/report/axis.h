#pragma once

#include <string>
#include <vector>

#include "design/report/value_scale.h"

namespace evenglow::design {

struct Tick {
  double value = 0.0;
  std::string label;
};

/// A scale with round ticks.
struct Axis {
  ValueScale range;
  bool logarithmic = false;
  std::vector<Tick> ticks;  ///< all within the range

  /// 0 to 1 along the axis; on a logarithmic axis what is not positive stands at 0.
  double position(double value) const;
};

/// Ticks at 1, 2, 2.5 or 5 times a power of ten, about `wanted` of them (two at least), within exactly
/// this range.
Axis linear_axis(const ValueScale& range, int wanted = 5);
/// The same with the range widened to the next ticks.
Axis rounded_axis(const ValueScale& range, int wanted = 5);
/// Whole numbers only.
Axis integer_axis(int low, int high, int wanted = 8);
/// Base 10. `low` and `high` positive, widened to 1, 2 or 5 times a power of ten; at most five decades below `high`.
Axis log_axis(const ValueScale& range);

}  // namespace evenglow::design
