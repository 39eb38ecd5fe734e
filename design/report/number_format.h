#pragma once

#include <string>

#include "core/montecarlo/estimate.h"

/// Numbers as text. Always with a decimal point, whatever the locale.
namespace evenglow::design {

/// The shortest text that reads back as the same number ("nan", "inf" if it is none): for tables.
std::string shortest(double value);

/// `digits` significant digits without an exponent for 1e-4 <= |value| < 1e7; an en dash if not finite: for people.
std::string rounded(double value, int digits = 4);

/// "3251 ± 12": the error to two significant digits, the value to the same decimals, both times `scale`
/// (100 for percent). Without an error (0 or not finite) the value alone to four digits.
std::string measured(const core::Estimate& estimate, double scale = 1.0);

/// A fraction in percent with its error: "61.24 ± 0.11 %".
std::string percent(const core::Estimate& fraction);

/// A count with thin gaps between the thousands: "20 000 000" (no-break spaces).
std::string grouped(unsigned long long count);

/// "48 s", "12.5 min", "3.1 h".
std::string duration(double seconds);

}  // namespace evenglow::design
