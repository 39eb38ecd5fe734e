#include "tracer/films/film_keys.h"

#include <utility>

#include <fmt/format.h>

namespace evenglow::tracer {
namespace {

constexpr double kDefaultGap = 0.05;  // mm

}  // namespace

Film film_of(std::string kind, const core::ConfigNode& node) {
  Film film;
  film.kind = std::move(kind);
  film.gap = node.number({"gap_mm", "air below the film", {0.001, 100.0, false, false}, kDefaultGap});
  return film;
}

double axis_of(const core::ConfigNode& node, std::string_view help) {
  return node.number({"axis_deg", help, {0.0, 180.0, false, true}, 0.0});
}

double share(const core::ConfigNode& node, std::string_view key, std::string_view help, double fallback) {
  return node.number({key, help, core::Range::closed(0, 1), fallback});
}

void require_sum(const core::ConfigNode& node, double whole, std::string_view whole_key, double& part,
                 std::string_view part_key) {
  if (whole + part <= 1.0 + 1e-12) return;
  node.fault_at(part_key, fmt::format("must be at most 1 - {} = {:g}, got {:g}", whole_key, 1.0 - whole, part));
  part = 1.0 - whole;
}

}  // namespace evenglow::tracer
