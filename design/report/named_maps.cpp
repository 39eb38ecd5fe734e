#include "design/report/named_maps.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/map_relations.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

void add(std::vector<NamedMap>& maps, std::string name, std::string unit, std::string description,
         const core::CellField& field) {
  if (!is_filled(field)) return;
  const std::string wanted = name;
  const auto taken = [&] {
    return std::any_of(maps.begin(), maps.end(), [&](const NamedMap& map) { return map.name == name; });
  };
  for (int number = 2; taken(); ++number) name = fmt::format("{}_{}", wanted, number);
  maps.push_back({std::move(name), std::move(unit), std::move(description), field});
}

void add_color(std::vector<NamedMap>& maps, const ColorJudgment& color) {
  add(maps, "color_u", "1", "u' of CIE 1976", color.u);
  add(maps, "color_u_se", "1", "standard error of u'", color.u_se);
  add(maps, "color_v", "1", "v' of CIE 1976", color.v);
  add(maps, "color_v_se", "1", "standard error of v'", color.v_se);
  add(maps, "delta_uv", "1", "distance in u', v' from the mean color of the active area", color.delta);
  add(maps, "delta_uv_se", "1", "standard error of that distance", color.delta_se);
}

std::string plain(std::string text) {
  const auto kept = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  std::replace_if(
      text.begin(), text.end(), [&](char c) { return !kept(c); }, '_');
  return text;
}

}  // namespace

std::vector<NamedMap> named_maps(const Report& report) {
  std::vector<NamedMap> maps;
  add(maps, "luminance", "cd/m2", "luminance of the active area, final trace", report.luminance);
  add(maps, "luminance_se", "cd/m2", "standard error of the luminance", report.luminance_se);
  add(maps, "start_luminance", "cd/m2", "luminance of the first step", report.start_luminance);
  add(maps, "target", "1", "wanted luminance, mean 1 over the cells that count (others 0)", report.target);
  add(maps, "density", "1", "share of the area under microstructure", report.density);
  if (report.color) add_color(maps, *report.color);
  return maps;
}

std::vector<NamedMap> named_maps(const Comparison& comparison) {
  std::vector<NamedMap> maps;
  for (std::size_t i = 1; i < comparison.variants.size(); ++i) {
    const Report& base = comparison.variants[0];
    const Report& report = comparison.variants[i];
    const std::string over = plain(report.variant) + "_over_" + plain(base.variant);
    const std::string minus = plain(report.variant) + "_minus_" + plain(base.variant);
    if (const auto ratio = luminance_ratio(report, base)) {
      add(maps, "ratio_" + over, "1", ratio->name + ": ratio of the luminance for equal LED flux", ratio->field);
      add(maps, "ratio_" + over + "_se", "1", ratio->name + ": standard error of the ratio", ratio->se);
    }
    if (const auto difference = luminance_difference(report, base)) {
      add(maps, "difference_" + minus, "cd/m2",
          difference->name + ": difference of the luminance for the LED flux of the first", difference->field);
      add(maps, "difference_" + minus + "_se", "cd/m2", difference->name + ": standard error of the difference",
          difference->se);
    }
    if (const auto density = density_difference(report, base))
      add(maps, "density_difference_" + minus, "1", density->name + ": difference of the density", density->field);
  }
  return maps;
}

}  // namespace evenglow::design
