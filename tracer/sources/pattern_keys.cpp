#include "tracer/sources/pattern_keys.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/sources/eulumdat_file.h"
#include "tracer/sources/ies_file.h"
#include "tracer/sources/intensity_csv.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr double kMaxExponent = 1000.0;

EmissionPattern read_cosine_power(const core::ConfigNode& node) {
  const double n = node.number({"exponent", "n of the intensity cos^n", Range::closed(0.1, kMaxExponent), 1.0});
  const auto half_angle =
      node.optional_number({"half_angle_deg", "angle at which the intensity cos^n is one half, instead of the exponent",
                            Range::closed(2.2, 89.9)});
  if (!half_angle) return EmissionPattern::cosine_power(n);
  if (node.has("exponent")) {
    node.fault_at("half_angle_deg", "must be left out where the exponent is given, got both");
  }
  return EmissionPattern::cosine_power(std::log(0.5) / std::log(std::cos(*half_angle)));
}

IntensityCsv read_file(const std::string& kind, const std::filesystem::path& file) {
  if (kind == "ies") return {read_ies_file(file), true};
  if (kind == "eulumdat") return {read_eulumdat_file(file), true};
  return read_intensity_csv(file);
}

}  // namespace

EmissionPattern read_emission_pattern(const core::ConfigNode& node) {
  const std::string kind = node.choice({"pattern",
                                        "angular pattern of the intensity",
                                        {"lambertian", "cosine_power", "cos_n", "tabulated", "ies", "eulumdat"},
                                        "lambertian"});
  EmissionPattern lambertian = EmissionPattern::cosine_power(1.0);
  if (kind == "lambertian") return lambertian;
  if (kind == "cosine_power" || kind == "cos_n") return read_cosine_power(node);
  const auto file = node.file(
      {"pattern_file", "luminous intensity against direction: CSV (tabulated), IES LM-63 (ies) or EULUMDAT (.ldt)"});
  const double turn = node.number({"pattern_turn_deg",
                                   "turns the pattern about the normal, counterclockwise seen from behind the source",
                                   Range::closed(-360, 360), 0.0});
  if (file.empty()) return lambertian;
  auto pattern = node.guarded("pattern_file", [&] {
    const IntensityCsv read = read_file(kind, file);
    return EmissionPattern::tabulated(read.table, turn, read.absolute);
  });
  if (pattern) return std::move(*pattern);
  return lambertian;
}

std::string pattern_note(const EmissionPattern& pattern) {
  if (pattern.left_out() < 1e-6) return {};
  return fmt::format("{:.3g} % of the flux of pattern_file goes beyond 90 degrees from the normal and is left out",
                     100.0 * pattern.left_out());
}

}  // namespace evenglow::tracer
