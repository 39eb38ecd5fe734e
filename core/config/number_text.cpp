#include "core/config/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"

namespace evenglow::core {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t digits_at(std::string_view text, std::size_t from) {
  std::size_t end = from;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - from;
}

enum class Form { kInteger, kDecimal, kZeroLed, kNone };

/// Which number, if any, the text is by the YAML 1.2 core schema. `kZeroLed` (`017`) means 15 to some readers of YAML
/// and 17 to others, so it is told apart.
Form form_of(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t whole = digits_at(text, 0);
  const bool zero_led = whole > 1 && text[0] == '0';
  if (whole == text.size() && whole > 0) return zero_led ? Form::kZeroLed : Form::kInteger;
  std::size_t at = whole;
  std::size_t fraction = 0;
  if (at < text.size() && text[at] == '.') {
    fraction = digits_at(text, at + 1);
    at += 1 + fraction;
  }
  if (whole + fraction == 0) return Form::kNone;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
    const std::size_t exponent = digits_at(text, at);
    if (exponent == 0) return Form::kNone;
    at += exponent;
  }
  if (at != text.size()) return Form::kNone;
  return zero_led ? Form::kZeroLed : Form::kDecimal;
}

template <typename T>
std::optional<T> converted(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);  // from_chars knows no plus
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_not_finite(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (text.starts_with('-') || text.starts_with('+')) text.erase(0, 1);
  return text == ".nan" || text == "nan" || text == ".inf" || text == "inf" || text == "infinity";
}

bool is_other_base(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X' || text[1] == 'o' || text[1] == 'b');
}

/// Why the value is not the `what` ("a number") that it must be.
std::string not_a_number(const ConfigValue& value, const std::string& what) {
  const std::string got = ", got " + described(value);
  if (!value.is_scalar()) return "must be " + what + got;
  if (value.quoted) return "must be " + what + " without quotes" + got;
  if (is_not_finite(value.text)) return "must be a finite number" + got;
  if (is_other_base(value.text)) return "must be a decimal number" + got;
  if (form_of(value.text) == Form::kZeroLed) return "must be " + what + " without leading zeros" + got;
  std::string with_point = value.text;
  const auto comma = with_point.find(',');
  if (comma != std::string::npos) with_point[comma] = '.';
  if (comma != std::string::npos && form_of(with_point) == Form::kDecimal) {
    return "must be " + what + " with a decimal point" + got;
  }
  return "must be " + what + got;
}

struct Unit {
  std::string_view name;
  double factor;  ///< ours = file * factor / divisor; the division keeps 25 um at the double next to 0.025
  double divisor;
};

// The longer endings come first.
constexpr std::array<Unit, 7> kUnits{{{"per_mm", 1, 1},
                                      {"per_m", 1, kMmPerM},
                                      {"mm", 1, 1},
                                      {"um", 1, 1000},
                                      {"deg", kRadPerDeg, 1},
                                      {"lm", 1, 1},
                                      {"nm", 1, 1}}};

const Unit* find_unit(std::string_view key) {
  for (const Unit& unit : kUnits) {
    if (key.size() > unit.name.size() && key.ends_with(unit.name) && key[key.size() - unit.name.size() - 1] == '_') {
      return &unit;
    }
  }
  return nullptr;
}

}  // namespace

Parsed<double> parse_number(const ConfigValue& value) {
  const Form form = value.is_scalar() && !value.quoted ? form_of(value.text) : Form::kNone;
  if (form == Form::kNone || form == Form::kZeroLed) return {{}, not_a_number(value, "a number")};
  const auto number = converted<double>(value.text);
  if (!number) return {{}, "must be a number that a computer's number can hold, got " + described(value)};
  return {number, ""};
}

Parsed<long long> parse_integer(const ConfigValue& value, bool exponent) {
  const std::string what = exponent ? "a whole number (20e6 is one too)" : "a whole number";
  const Form form = value.is_scalar() && !value.quoted ? form_of(value.text) : Form::kNone;
  if (form == Form::kInteger) {
    const auto number = converted<long long>(value.text);
    if (!number) return {{}, "must be a whole number of at most 18 digits, got " + described(value)};
    return {number, ""};
  }
  if (!exponent || form != Form::kDecimal) return {{}, not_a_number(value, what)};
  const auto number = converted<double>(value.text);
  if (!number || std::abs(*number) >= 1e18) {
    return {{}, "must be a whole number of at most 18 digits, got " + described(value)};
  }
  if (std::trunc(*number) != *number) return {{}, not_a_number(value, what)};
  return {static_cast<long long>(*number), ""};
}

Parsed<bool> parse_boolean(const ConfigValue& value) {
  const bool plain = value.is_scalar() && !value.quoted;
  const std::string& text = value.text;
  if (plain && (text == "true" || text == "True" || text == "TRUE")) return {true, ""};
  if (plain && (text == "false" || text == "False" || text == "FALSE")) return {false, ""};
  return {{}, "must be true or false, got " + described(value)};
}

std::string_view unit_of(std::string_view key) {
  const Unit* unit = find_unit(key);
  return unit != nullptr ? unit->name : std::string_view{};
}

double to_internal(std::string_view key, double value) {
  const Unit* unit = find_unit(key);
  return unit != nullptr ? value * unit->factor / unit->divisor : value;
}

std::string requirement(const Range& range) {
  const bool from = std::isfinite(range.min);
  const bool to = std::isfinite(range.max);
  if (from && to) return "must lie in " + range.to_string();
  if (from) return (range.min_open ? "must be greater than " : "must be at least ") + number_text(range.min);
  if (to) return (range.max_open ? "must be less than " : "must be at most ") + number_text(range.max);
  return "must be a number";
}

std::string requirement(long long min, long long max) {
  const bool from = min != std::numeric_limits<long long>::min();
  const bool to = max != std::numeric_limits<long long>::max();
  if (from && to) return fmt::format("must lie in [{}, {}]", min, max);
  if (from) return fmt::format("must be at least {}", min);
  if (to) return fmt::format("must be at most {}", max);
  return "must be a whole number";
}

double some_number(const Range& range) {
  const bool from = std::isfinite(range.min);
  const bool to = std::isfinite(range.max);
  if (from && to) return range.min + (range.max - range.min) / 2;
  if (from) return range.min + 1;
  if (to) return range.max - 1;
  return 1;
}

std::string number_text(double value) {
  return fmt::format("{}", value);
}

bool Range::contains(double value) const {
  const bool above = min_open ? value > min : value >= min;
  const bool below = max_open ? value < max : value <= max;
  return std::isfinite(value) && above && below;
}

std::string Range::to_string() const {
  const bool open_left = min_open || std::isinf(min);
  const bool open_right = max_open || std::isinf(max);
  return fmt::format("{}{}, {}{}", open_left ? '(' : '[', min, max, open_right ? ')' : ']');
}

}  // namespace evenglow::core
