#include "design/report/axis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace evenglow::design {
namespace {

/// The least of 1, 2, 2.5, 5, 10 times a power of ten that is not below `raw`.
double round_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::string label_of(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  if (std::abs(value) >= 1e6 || step < 1e-5) return fmt::format("{:.6g}", value);
  int decimals = 0;
  for (double rest = step; decimals < 8 && std::abs(rest - std::round(rest)) > 1e-6 * rest; rest *= 10.0) ++decimals;
  return fmt::format("{:.{}f}", value, decimals);
}

Axis with_step(const ValueScale& range, double step) {
  Axis axis{range, false, {}};
  const double slack = 1e-9 * step;
  for (double n = std::ceil((range.low - slack) / step); n * step <= range.high + slack; n += 1.0) {
    axis.ticks.push_back({n * step, label_of(n * step, step)});
  }
  return axis;
}

double step_for(const ValueScale& range, int wanted) {
  return round_step((range.high - range.low) / wanted);
}

/// 1, 2, 5 times powers of ten; `n` counts them, 0 is 1.
double one_two_five(int n) {
  constexpr std::array<double, 3> factors{1.0, 2.0, 5.0};
  const int decade = static_cast<int>(std::floor(n / 3.0));
  return factors[static_cast<std::size_t>(n - 3 * decade)] * std::pow(10.0, decade);
}

}  // namespace

double Axis::position(double value) const {
  if (!logarithmic) return range.share(value);
  if (!(value > 0.0)) return 0.0;
  return std::log(value / range.low) / std::log(range.high / range.low);
}

Axis linear_axis(const ValueScale& range, int wanted) {
  Axis axis = with_step(range, step_for(range, wanted));
  // One tick tells no scale.
  for (int more = wanted + 1; axis.ticks.size() < 2 && more < 20; ++more)
    axis = with_step(range, step_for(range, more));
  return axis;
}

Axis rounded_axis(const ValueScale& range, int wanted) {
  const double step = step_for(range, wanted);
  const double low = std::floor(range.low / step + 1e-9) * step;
  const double high = std::ceil(range.high / step - 1e-9) * step;
  return with_step({low, std::max(high, low + step)}, step);
}

Axis integer_axis(int low, int high, int wanted) {
  const double step = std::max(1.0, std::round(step_for({double(low), double(std::max(high, low + 1))}, wanted)));
  return with_step({low - 0.35, high + 0.35}, step);
}

Axis log_axis(const ValueScale& range) {
  const double low = std::max(range.low, range.high * 1e-5);
  int first = static_cast<int>(std::floor(3.0 * std::log10(low))) - 2;
  while (one_two_five(first + 1) <= low * (1.0 + 1e-9)) ++first;
  int last = first + 1;
  while (one_two_five(last) < range.high * (1.0 - 1e-9)) ++last;
  Axis axis{{one_two_five(first), one_two_five(last)}, true, {}};
  const bool decades_only = last - first > 9;
  for (int n = first; n <= last; ++n) {
    if (!decades_only || n % 3 == 0) axis.ticks.push_back({one_two_five(n), fmt::format("{:.6g}", one_two_five(n))});
  }
  return axis;
}

}  // namespace evenglow::design
