#include "tests/soak/run_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

#include <fmt/core.h>

namespace evenglow::tests {
namespace {

using core::DeclaredKey;

constexpr double kOptionalShare = 0.22;
constexpr int kDeepest = 5;

/// Not of the backlight, of the machine's files, or lists as long as a row has LEDs.
constexpr std::array kLeftOut = {"include",   "variants",     "sweep",      "evenglow",         "title",     "design",
                                 "optimize",  "optimise",     "dots",       "output",           "optimizer", "trace",
                                 "dots_file", "flux_factors", "offsets_mm", "height_offsets_mm"};
/// What makes a trace long or a memory full, without being another case: kept few.
constexpr std::array kFew = {"cells", "count", "wavelengths", "polar_count", "azimuth_count", "segments"};
/// Kinds that need a file.
constexpr std::array kKindsOfFiles = {"mueller_table", "ray_file"};

bool is_in(const auto& words, const std::string& word) {
  return std::any_of(words.begin(), words.end(), [&](const char* one) { return word == one; });
}

std::string text_of(double value, bool whole) {
  return whole ? fmt::format("{}", static_cast<long long>(std::llround(value))) : fmt::format("{:.6g}", value);
}

}  // namespace

RunGenerator::RunGenerator(std::vector<DeclaredKey> keys, std::uint64_t seed) : keys_(std::move(keys)), random_(seed) {}

std::string RunGenerator::next() {
  return "evenglow: 1\ntitle: soak\ntrace: {seed: " + std::to_string(random_() % 1000) +
         (chance(0.3) ? ", path: general" : "") + "}\nbacklight: " + map_of("backlight", 0) + "\n";
}

RunGenerator::Keys RunGenerator::keys_of(const std::string& node, const std::string& kind) const {
  Keys found;
  for (const DeclaredKey& key : keys_) {
    if (key.node == node && (key.kind.empty() || key.kind == kind) && !is_in(kLeftOut, key.key)) found.push_back(&key);
  }
  return found;
}

std::string RunGenerator::kind_of(const std::string& node) {
  for (const DeclaredKey& key : keys_) {
    if (key.node != node || key.key != "kind" || key.type != "choice") continue;
    for (int tries = 0; tries < 20; ++tries) {
      const std::string& kind = key.options[below(key.options.size())];
      if (!is_in(kKindsOfFiles, kind)) return kind;
    }
  }
  return "";
}

std::string RunGenerator::map_of(const std::string& node, int depth) {
  const std::string kind = kind_of(node);
  std::string text = kind.empty() ? "" : "kind: " + kind;
  std::set<std::string> taken = {"kind"};
  for (const DeclaredKey* key : keys_of(node, kind)) {
    const bool backlight = node == "backlight";
    double share = key->required ? 1.0 : kOptionalShare;
    if (backlight && (key->key == "light_guide_plate" || key->key == "sources")) share = 0.95;
    if (backlight && (key->key == "films" || key->key == "reflectors" || key->key == "microstructure")) share = 0.8;
    if (backlight && key->key == "size") share = taken.contains("light_guide_plate") ? 0.0 : 1.0;
    if (key->type == "file") share = 0.0;
    if (taken.contains(key->key) || !chance(share)) continue;
    const std::string value = value_of(*key, depth + 1);
    if (value.empty()) continue;
    taken.insert(key->key);
    text += (text.empty() ? "" : ", ") + key->key + ": " + value;
  }
  return "{" + text + "}";
}

std::string RunGenerator::value_of(const DeclaredKey& key, int depth) {
  const std::string path = key.node.empty() ? key.key : key.node + "." + key.key;
  if (key.type == "map") return depth > kDeepest ? "" : map_of(path, depth);
  if (key.type == "maps") {
    if (depth > kDeepest) return "";
    std::string list;
    const std::size_t most = path == "backlight.films" ? 5 : 2;
    for (std::size_t i = 1 + below(most); i > 0; --i) list += (list.empty() ? "" : ", ") + map_of(path + "[]", depth);
    return "[" + list + "]";
  }
  if (key.type == "boolean") return chance(0.5) ? "true" : "false";
  if (key.type == "choice") return key.options[below(key.options.size())];
  if (key.type == "numbers") return numbers_of(key);
  if (key.type == "number" || key.type == "integer" || key.type == "count") return number_of(key, key.fallback);
  return "";
}

std::string RunGenerator::number_of(const DeclaredKey& key, const std::string& fallback) {
  const bool whole = key.whole || key.type != "number";
  const core::Range range = key.range.value_or(core::Range::any());
  if (is_in(kFew, key.key)) return text_of(std::max(range.min, 1.0 + static_cast<double>(below(12))), true);
  const double usual =
      fallback.empty() ? std::clamp(1.0, range.min, range.max) : std::strtod(fallback.c_str(), nullptr);
  const double low = std::isfinite(range.min) ? range.min : -10.0 * std::abs(usual) - 1.0;
  const double high = std::isfinite(range.max) ? range.max : 10.0 * std::abs(usual) + 1.0;
  double value = usual;
  if (chance(0.7)) {
    value = usual != 0.0 ? usual * std::exp(0.7 * (2.0 * uniform() - 1.0)) : low + (high - low) * 0.2 * uniform();
  } else if (chance(0.8)) {
    value = low + (high - low) * uniform();
  } else {
    value = chance(0.5) ? low : high;  // an open end is refused, now and then
  }
  value = std::clamp(value, low, high);
  return text_of(value, whole);
}

std::string RunGenerator::numbers_of(const DeclaredKey& key) {
  const std::size_t spread = std::min<std::size_t>(key.max_count, key.min_count + 3) - key.min_count;
  std::string list;
  for (std::size_t i = key.min_count + below(spread + 1); i > 0; --i)
    list += (list.empty() ? "" : ", ") + number_of(key, "");
  return "[" + list + "]";
}

}  // namespace evenglow::tests
