#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/config/config_node.h"
#include "core/config/config_value.h"

/// From the text of a scalar to a number, and the words for what is allowed.
namespace evenglow::core {

/// A number, or what is wrong ("must be a number, got a list").
template <typename T>
struct Parsed {
  std::optional<T> value{};
  std::string fault{};
};

/// A finite decimal number as in the YAML 1.2 core schema (`-1.5`, `.5`, `20e6`).
Parsed<double> parse_number(const ConfigValue& value);

/// A whole number. With `exponent`, also one such as `20e6` or `2.5e6`.
Parsed<long long> parse_integer(const ConfigValue& value, bool exponent);

Parsed<bool> parse_boolean(const ConfigValue& value);

/// The unit that a key ends in (`mm`, `um`, `deg`, `lm`, `nm`, `per_m`, `per_mm`); empty if none.
std::string_view unit_of(std::string_view key);

/// From the unit that the key ends in to ours.
double to_internal(std::string_view key, double value);

/// "must lie in [0, 180)", "must be at least 1", "must be greater than 0", "must be a number".
std::string requirement(const Range& range);
std::string requirement(long long min, long long max);

/// Some number of the range, for reading on after a fault.
double some_number(const Range& range);

/// The shortest text that reads back as the same number.
std::string number_text(double value);

}  // namespace evenglow::core
