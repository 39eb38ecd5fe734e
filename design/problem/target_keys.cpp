#include "design/problem/target_keys.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "tracer/scene/density_file.h"

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;

constexpr core::MatrixRange kTargetRange = {0.0, 1e12, "a luminance of at least 0 (0: the cell does not count)"};

bool is_dark(const MapTable& map) {
  return std::all_of(map.values.begin(), map.values.end(), [](double value) { return value <= 0.0; });
}

MapTable read_target_map(const ConfigNode& node) {
  MapTable map =
      read_map_key(node, {"csv", "luminance over the display as a matrix, any unit", std::string()}, kTargetRange);
  const auto picture = node.file(
      {"png", "luminance over the display as a picture (PNG or TIFF), linear from black to white", std::string()});
  if (!picture.empty()) {
    if (auto read = node.guarded("png", [&] { return core::read_picture(picture); })) map = MapTable{std::move(*read)};
  }
  if (!map.empty() && is_dark(map)) node.fault("must be above 0 in at least one cell, got a dark map");
  return map;
}

}  // namespace

MapTable read_map_key(const ConfigNode& node, const core::TextKey& key, const core::MatrixRange& range) {
  const auto path = node.file(key);
  if (path.empty()) return {};
  auto table = node.guarded(key.key, [&] { return core::read_matrix_csv(path, range); });
  return table ? MapTable{std::move(*table)} : MapTable{};
}

TargetSpec read_target(const ConfigNode& design) {
  TargetSpec spec;
  if (!design.has_map("target")) {
    spec.kind = design.choice(
        {"target", "wanted shape of the luminance", {"uniform", "center_weighted"}, std::string(spec.kind)});
    return spec;
  }
  const ConfigNode node = design.map("target", "wanted shape of the luminance");
  if (node.has("csv") && node.has("png")) node.fault("must name csv or png, got both");
  spec.map = read_target_map(node);
  if (node.has("csv") || node.has("png")) {
    spec.kind = spec.map.empty() ? "uniform" : "map";
    return spec;
  }
  spec.kind = node.choice({"kind", "shape of the luminance", {"uniform", "center_weighted"}, std::string("uniform")});
  if (spec.kind == "center_weighted")
    spec.corner = node.number(
        {"corner", "luminance at the corners over that at the center", Range{0, 2, true, false}, spec.corner});
  return spec;
}

StartSpec read_start(const ConfigNode& design) {
  StartSpec spec;
  if (!design.has_map("start")) {
    spec.kind = design.choice({"start",
                               "density to begin with: what backlight.microstructure says, or from the flux of guided "
                               "light along the plate",
                               {"flat", "analytic"},
                               std::string(spec.kind)});
    return spec;
  }
  const ConfigNode node = design.map("start", "density to begin with");
  const auto file =
      node.file({"file", "density over the plate: a matrix (CSV) or a picture (PNG, TIFF)", std::string()});
  if (!file.empty()) {
    if (auto read = node.guarded("file", [&] { return tracer::read_density_file(file); }))
      spec.map = MapTable{std::move(*read)};
  }
  const auto earlier =
      node.file_in({"result", "directory of an earlier result, also of other cells", std::string()}, "density.csv");
  if (!earlier.empty()) {
    if (auto read = node.guarded("result", [&] { return tracer::read_density_file(earlier); }))
      spec.map = MapTable{std::move(*read)};
  }
  if (node.has("file") == node.has("result")) node.fault("must name file or result, one of them");
  if (!spec.map.empty()) spec.kind = "map";
  return spec;
}

GoalSpec read_goal(const ConfigNode& design) {
  GoalSpec spec;
  spec.kind = design.choice({"goal",
                             "even: stop_rms at the knee of the efficiency; max_efficiency: the highest efficiency "
                             "whose RMS keeps a bound; min_rms: the most even design whose efficiency keeps a bound",
                             {"even", "max_efficiency", "min_rms"},
                             std::string(spec.kind)});
  const ConfigNode node = design.map("subject_to", "bounds of the design");
  spec.color = node.optional_number({"color",
                                     "RMS distance of the colors of the cells from their mean in (u', v'), noise taken "
                                     "off, that must not be passed; needs a receiver of kind color",
                                     Range{0, 1, true, false}});
  if (spec.kind == "max_efficiency") {
    spec.rms = node.number({"rms", "noise-corrected RMS that must not be passed", Range{0, 1, true, false}});
  } else if (spec.kind == "min_rms") {
    spec.efficiency = node.number({"efficiency", "share of the flux that must leave the top", Range{0, 1, true, true}});
  }
  for (const auto& [key, kind] : {std::pair{"rms", "max_efficiency"}, std::pair{"efficiency", "min_rms"}}) {
    if (spec.kind == kind || !node.has(key)) continue;
    node.fault_at(key, fmt::format("belongs to the goal {}, got it with goal {}", kind, spec.kind));
    node.optional_number({key, "", Range{0, 1, true, true}});
  }
  return spec;
}

}  // namespace evenglow::design
