#include "design/report/number_format.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace evenglow::design {
namespace {

constexpr const char* no_break_space = "\u00a0";
constexpr const char* no_value = "\u2013";

/// Decimals that show `digits` significant digits of `value`; not negative.
int decimals_of(double value, int digits) {
  if (value == 0.0) return 0;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  return std::clamp(digits - 1 - exponent, 0, 12);
}

}  // namespace

std::string shortest(double value) {
  return fmt::format("{}", value);
}

std::string rounded(double value, int digits) {
  if (!std::isfinite(value)) return no_value;
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}e}", value, digits - 1);
  return fmt::format("{:.{}f}", value, decimals_of(value, digits));
}

std::string measured(const core::Estimate& estimate, double scale) {
  const double value = estimate.value * scale;
  const double se = estimate.se * scale;
  if (!std::isfinite(value)) return no_value;
  if (!std::isfinite(se) || se <= 0.0) return rounded(value);
  const double size = std::max(std::abs(value), se);
  if (size < 1e-4 || size >= 1e9 || se < 1e-7 * size) return fmt::format("{:.5g} ± {:.2g}", value, se);
  const int decimals = decimals_of(se, 2);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, se, decimals);
}

std::string percent(const core::Estimate& fraction) {
  return measured(fraction, 100.0) + no_break_space + "%";
}

std::string grouped(unsigned long long count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), no_break_space);
  }
  return digits;
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return no_value;
  if (seconds < 120.0) return rounded(seconds, 3) + no_break_space + "s";
  if (seconds < 7200.0) return rounded(seconds / 60.0, 3) + no_break_space + "min";
  return rounded(seconds / 3600.0, 3) + no_break_space + "h";
}

}  // namespace evenglow::design
