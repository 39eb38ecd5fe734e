#include "tracer/microstructure/bump_keys.h"

#include <cmath>

#include <fmt/core.h>

#include "core/base/units.h"
#include "tracer/microstructure/pattern_face.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

BumpPlacement placed(const ConfigNode& node, double axis) {
  const bool sunk =
      node.choice({"form", "bumps of the plate's material, or dents in it", {"raised", "sunk"}, "raised"}) == "sunk";
  return {sunk ? BumpPlacement::Form::kSunk : BumpPlacement::Form::kRaised, axis, read_pattern_on_top(node)};
}

}  // namespace

BumpPlacement read_placement(const ConfigNode& node) {
  return placed(node, 0.0);
}

BumpPlacement read_placement(const ConfigNode& node, const char* axis_help, double default_axis_deg) {
  return placed(node, node.number({"axis_deg", axis_help, {0, 180, false, true}, default_axis_deg}));
}

double read_fill(const ConfigNode& node, double greatest) {
  const double fill =
      node.number({"fill", "share of the patterned area under footprints, the rest bare face between them",
                   Range::closed(0.01, 1), 1.0});
  if (fill <= greatest || fill == 1.0) return fill;
  node.fault_at("fill",
                fmt::format("must lie in [0.01, {:g}] or be 1 for a round footprint, got {:g}", greatest, fill));
  return 1.0;
}

Flank read_flank(const ConfigNode& node) {
  Flank flank;
  flank.truncation = node.number(
      {"truncation", "width of the flat top over that of the footprint; 0: pointed", {0, 0.95, false, false}, 0.0});
  flank.angle = node.number({"flank_deg", "angle between flank and face", Range::closed(0.1, kSteepest), 45.0});
  const auto aspect = node.optional_number(
      {"aspect", "height over width of the footprint, instead of flank_deg", Range::closed(1e-4, 10)});
  if (!aspect) return flank;
  if (node.has("flank_deg")) node.fault_at("aspect", "must be left out where flank_deg is given, got both");
  flank.angle = std::atan(2.0 * *aspect / (1.0 - flank.truncation));
  if (flank.angle > kSteepest * core::kRadPerDeg) {
    node.fault_at("aspect",
                  fmt::format("must not make flanks steeper than {:g} deg, got {:g} deg with the truncation {:g}",
                              kSteepest, flank.angle / core::kRadPerDeg, flank.truncation));
    flank.angle = kSteepest * core::kRadPerDeg;
  }
  return flank;
}

}  // namespace evenglow::tracer
