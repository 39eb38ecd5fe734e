#include "design/tolerance/yield.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {

Share wilson(double successes, double n) {
  constexpr double z = 1.959963984540054;
  const double p = successes / n, z2 = z * z;
  const double middle = (p + 0.5 * z2 / n) / (1.0 + z2 / n);
  const double half = z / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + 0.25 * z2 / (n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

bool keeps(const Limit& limit, double value) {
  return !(limit.min && value < *limit.min) && !(limit.max && value > *limit.max) && std::isfinite(value);
}

Yield yield_of(const std::vector<LimitedFigure>& figures) {
  core::expects(!figures.empty() && !figures.front().seen.empty(), "a yield needs a limit and samples");
  const std::size_t count = figures.front().seen.size();
  Yield yield;
  int passed_corrected = 0, surely = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bool passes = true, corrected = true, sure_to_pass = true, sure_to_fail = false;
    for (const LimitedFigure& f : figures) {
      const core::Estimate& s = f.seen[i];
      const double center = s.value - f.shift;
      const bool low = keeps(f.limit, center - 2.0 * s.se), high = keeps(f.limit, center + 2.0 * s.se);
      passes = passes && keeps(f.limit, s.value);
      corrected = corrected && keeps(f.limit, f.corrected[i]);
      sure_to_pass = sure_to_pass && low && high;
      sure_to_fail = sure_to_fail || (!low && !high && !keeps(f.limit, center));
    }
    yield.passed += passes ? 1 : 0;
    passed_corrected += corrected ? 1 : 0;
    surely += sure_to_pass ? 1 : 0;
    yield.near_limit += !sure_to_pass && !sure_to_fail ? 1 : 0;
  }
  const auto n = static_cast<double>(count);
  yield.seen = wilson(yield.passed, n);
  yield.corrected = wilson(passed_corrected, n);
  yield.least = surely / n;
  yield.most = (surely + yield.near_limit) / n;
  return yield;
}

}  // namespace evenglow::design
