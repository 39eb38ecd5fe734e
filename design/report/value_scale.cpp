#include "design/report/value_scale.h"

#include <algorithm>
#include <cmath>

namespace evenglow::design {

bool is_filled(const core::CellField& field) {
  return !field.values.empty() && field.values.size() == field.grid.size();
}

FieldSummary summarize(const core::CellField& field) {
  FieldSummary summary;
  double sum = 0.0;
  for (const double value : field.values) {
    if (!std::isfinite(value)) continue;
    summary.min = summary.count == 0 ? value : std::min(summary.min, value);
    summary.max = summary.count == 0 ? value : std::max(summary.max, value);
    sum += value;
    ++summary.count;
  }
  if (summary.count > 0) summary.mean = sum / static_cast<double>(summary.count);
  return summary;
}

ValueScale common_scale(const std::vector<const core::CellField*>& fields) {
  bool found = false;
  ValueScale scale;
  for (const core::CellField* field : fields) {
    const FieldSummary summary = summarize(*field);
    if (summary.count == 0) continue;
    scale.low = found ? std::min(scale.low, summary.min) : summary.min;
    scale.high = found ? std::max(scale.high, summary.max) : summary.max;
    found = true;
  }
  if (!found) return {};
  const double least = 1e-6 * std::max({std::abs(scale.low), std::abs(scale.high), 1e-6});
  if (scale.high - scale.low >= least) return scale;
  if (scale.low == 0.0 && scale.high == 0.0) return {0.0, 1.0};  // dark: no luminance is negative
  const double half = std::max(0.05 * std::abs(scale.high), 0.05);
  return {scale.low - half, scale.high + half};
}

}  // namespace evenglow::design
