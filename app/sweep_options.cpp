#include "app/sweep_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::app {
namespace {

using tracer::SweepLight;

constexpr std::array<std::pair<const char*, SweepLight>, 6> kLights{{{"none", SweepLight::natural},
                                                                     {"pass", SweepLight::pass},
                                                                     {"block", SweepLight::block},
                                                                     {"45", SweepLight::diagonal},
                                                                     {"right", SweepLight::right},
                                                                     {"left", SweepLight::left}}};

[[noreturn]] void refuse(const std::string& option, const std::string& message) {
  throw core::ConfigError(core::Fault{option, 0, 0, "", message});
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<double> number_of(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.eE+-") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// FROM, FROM + STEP, ... up to TO; a last step that misses TO by rounding alone counts.
std::vector<double> stepped(const std::string& option, double from, double to, double step) {
  if (!(step > 0.0)) refuse(option, fmt::format("STEP must be above 0, got {:g}", step));
  if (to < from) refuse(option, fmt::format("TO must be at least FROM = {:g}, got {:g}", from, to));
  const double steps = std::floor((to - from) / step + 1e-9);
  if (steps >= static_cast<double>(kMostSweepValues)) {
    refuse(option, fmt::format("must name at most {} values, got {:g}", kMostSweepValues, steps + 1.0));
  }
  std::vector<double> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) values.push_back(std::min(from + i * step, to));
  return values;
}

}  // namespace

std::vector<double> sweep_values(const std::string& option, const std::string& text, const SweepRange& range) {
  const bool is_range = text.find(':') != std::string::npos;
  std::vector<double> values;
  for (const std::string& part : parts_of(text, is_range ? ':' : ',')) {
    const auto value = number_of(part);
    if (!value) {
      refuse(option, "must be FROM:TO:STEP, a number or numbers parted by commas, got " + core::shown(text));
    }
    values.push_back(*value);
  }
  if (is_range) {
    if (values.size() != 3) refuse(option, "must be FROM:TO:STEP, got " + core::shown(text));
    values = stepped(option, values[0], values[1], values[2]);
  }
  if (values.size() > kMostSweepValues) {
    refuse(option, fmt::format("must name at most {} values, got {}", kMostSweepValues, values.size()));
  }
  for (const double value : values) {
    if (value >= range.min && (range.max_open ? value < range.max : value <= range.max)) continue;
    refuse(option,
           fmt::format("must lie in [{:g}, {:g}{}, got {:g}", range.min, range.max, range.max_open ? ")" : "]", value));
  }
  return values;
}

std::vector<SweepLight> sweep_lights(const std::string& text) {
  std::vector<SweepLight> lights;
  for (const std::string& part : parts_of(text, ',')) {
    if (part == "all") {
      for (const auto& [name, light] : kLights) lights.push_back(light);
      continue;
    }
    const auto found =
        std::find_if(kLights.begin(), kLights.end(), [&](const auto& entry) { return part == entry.first; });
    if (found == kLights.end()) {
      refuse("--polarization", "must be all, or some of none, pass, block, 45, right, left, got " + core::shown(part));
    }
    lights.push_back(found->second);
  }
  std::vector<SweepLight> once;
  for (const SweepLight light : lights) {
    if (std::find(once.begin(), once.end(), light) == once.end()) once.push_back(light);
  }
  return once;
}

const char* name_of(SweepLight light) {
  for (const auto& [name, value] : kLights) {
    if (value == light) return name;
  }
  return "";
}

std::uint64_t sweep_photons(const std::string& text) {
  const auto value = number_of(text);
  if (!value || *value < 1.0 || *value > 1e9 || *value != std::floor(*value)) {
    refuse("--photons", "must be a whole number in [1, 1e9], got " + core::shown(text));
  }
  return static_cast<std::uint64_t>(*value);
}

}  // namespace evenglow::app
