#include "design/report/map_relations.h"

#include <cmath>
#include <limits>

#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

bool comparable(const core::CellField& a, const core::CellField& b) {
  return is_filled(a) && is_filled(b) && a.grid == b.grid;
}

/// Standard errors of the luminance; zeros where there are none.
core::CellField errors_of(const Report& report) {
  if (is_filled(report.luminance_se) && report.luminance_se.grid == report.luminance.grid) return report.luminance_se;
  return {report.luminance.grid, 0.0};
}

}  // namespace

std::optional<RelatedMap> luminance_ratio(const Report& report, const Report& base) {
  if (!comparable(report.luminance, base.luminance)) return std::nullopt;
  const double flux = base.energy.emitted_lm / report.energy.emitted_lm;
  const core::CellField se = errors_of(report);
  const core::CellField base_se = errors_of(base);
  RelatedMap map{report.variant + " / " + base.variant, {base.luminance.grid, 0.0}, {base.luminance.grid, 0.0}};
  for (std::size_t i = 0; i < map.field.values.size(); ++i) {
    const double below = base.luminance.values[i];
    const double ratio = below > 0.0 ? report.luminance.values[i] / below : std::numeric_limits<double>::quiet_NaN();
    map.field.values[i] = flux * ratio;
    map.se.values[i] = flux * std::hypot(se.values[i], ratio * base_se.values[i]) / below;
  }
  return map;
}

std::optional<RelatedMap> luminance_difference(const Report& report, const Report& base) {
  if (!comparable(report.luminance, base.luminance)) return std::nullopt;
  const double flux = base.energy.emitted_lm / report.energy.emitted_lm;
  const core::CellField se = errors_of(report);
  const core::CellField base_se = errors_of(base);
  RelatedMap map{report.variant + " \u2212 " + base.variant, {base.luminance.grid, 0.0}, {base.luminance.grid, 0.0}};
  for (std::size_t i = 0; i < map.field.values.size(); ++i) {
    map.field.values[i] = flux * report.luminance.values[i] - base.luminance.values[i];
    map.se.values[i] = std::hypot(flux * se.values[i], base_se.values[i]);
  }
  return map;
}

std::optional<RelatedMap> density_difference(const Report& report, const Report& base) {
  if (!comparable(report.density, base.density)) return std::nullopt;
  RelatedMap map{report.variant + " \u2212 " + base.variant, {base.density.grid, 0.0}, {}};
  for (std::size_t i = 0; i < map.field.values.size(); ++i)
    map.field.values[i] = report.density.values[i] - base.density.values[i];
  return map;
}

}  // namespace evenglow::design
