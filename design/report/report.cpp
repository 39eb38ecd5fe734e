#include "design/report/report.h"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// a / b of independent estimates; unlike core::ratio also for a = 0. Not a number for b = 0.
core::Estimate quotient(const core::Estimate& a, const core::Estimate& b) {
  const double value = a.value / b.value;
  return {value, std::hypot(a.se, value * b.se) / std::abs(b.value)};
}

core::Estimate per_lumen(const core::Estimate& quantity, double emitted_lm) {
  return {quantity.value / emitted_lm, quantity.se / emitted_lm};
}

/// Names become keys of compare.json and directories: never empty, never twice the same.
void name_variants(std::vector<Report>& variants) {
  std::set<std::string> taken;
  for (Report& report : variants) {
    const std::string wanted = report.variant.empty() ? "variant" : report.variant;
    std::string name = wanted;
    for (int number = 2; !taken.insert(name).second; ++number) name = wanted + "-" + std::to_string(number);
    report.variant = std::move(name);
  }
}

VariantRatio ratio_of(const Report& report, const Report& base) {
  const auto luminance = [](const Report& r) { return per_lumen(r.final.luminance_mean, r.energy.emitted_lm); };
  const core::Estimate efficiency = quotient(report.final.efficiency, base.final.efficiency);
  // Out of the top goes efficiency x emitted; for equal emitted flux the ratio is that of the efficiencies.
  return {report.variant + "/" + base.variant, quotient(luminance(report), luminance(base)), efficiency, efficiency};
}

}  // namespace

std::string film_note(std::size_t index, const FilmEntry& film, const std::string& remark) {
  return fmt::format("films[{}] ({}): {}", index, film.kind, remark);
}

Comparison compare_reports(std::string title, std::string command, std::vector<Report> variants) {
  core::expects(!variants.empty(), "a comparison has at least one variant");
  name_variants(variants);
  Comparison comparison{std::move(title), std::move(command), std::move(variants), {}};
  for (std::size_t i = 1; i < comparison.variants.size(); ++i) {
    comparison.ratios.push_back(ratio_of(comparison.variants[i], comparison.variants[0]));
  }
  return comparison;
}

}  // namespace evenglow::design
