#include "tracer/scene/plate_keys.h"

#include <memory>
#include <string>

#include <fmt/core.h>

#include "core/base/units.h"
#include "tracer/microstructure/bump_keys.h"
#include "tracer/microstructure/v_groove.h"
#include "tracer/scene/material_keys.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

constexpr Range kLength = {0.1, 10000.0, false, false};
constexpr double kDefaultLength = 140.0;
constexpr double kDefaultWidth = 66.0;

double read_end_thickness(const ConfigNode& node, double thickness) {
  const double end = node.number({"end_thickness_mm",
                                  "thickness at the right edge, of a wedge; default: that at the left",
                                  {0.01, 1000.0},
                                  thickness});
  if (end <= thickness) return end;
  node.fault_at("end_thickness_mm", fmt::format("must be at most thickness_mm = {:g} mm, got {:g} mm", thickness, end));
  return thickness;
}

std::optional<EntranceTexture> read_entrance(const ConfigNode& plate) {
  const ConfigNode node = plate.map("entrance", "serrations of end faces, which spread the light of the LEDs");
  if (!node.present()) return {};
  EntranceTexture texture;
  for (const std::string& name :
       node.choices({"edges", "edges whose end face is serrated", {"left", "right", "front", "back"}, "left"})) {
    for (int i = 0; i < kSides; ++i) {
      if (name == side_name(static_cast<Side>(i))) texture.sides.push_back(static_cast<Side>(i));
    }
  }
  const double flank = node.number(
      {"flank_deg", "between the flanks of the serrations and the face", Range::closed(0.1, kSteepest), 30.0});
  const double fill = read_fill(node, 1.0);
  const bool sunk = node.choice({"form", "cut into the face, or standing on it", {"sunk", "raised"}, "sunk"}) == "sunk";
  const auto form = sunk ? BumpPlacement::Form::kSunk : BumpPlacement::Form::kRaised;
  texture.optics = [flank, fill, form](double index, double axis) -> std::unique_ptr<const Bsdf> {
    return std::make_unique<TracedBump<Ridge>>(Ridge(flank, flank, fill), BumpPlacement(form, axis, true), index);
  };
  return texture;
}

}  // namespace

LightGuidePlateSpec read_plate(const ConfigNode& node) {
  LightGuidePlateSpec plate;
  plate.length = node.number({"length_mm", "length, along x, away from the left edge", kLength, kDefaultLength});
  plate.width = node.number({"width_mm", "width, along y", kLength, kDefaultWidth});
  plate.thickness = node.number({"thickness_mm", "thickness at the left edge", {0.01, 1000.0, false, false}, 0.6});
  plate.end_thickness = read_end_thickness(node, plate.thickness);
  plate.material = read_material(node);
  plate.entrance = read_entrance(node);
  return plate;
}

}  // namespace evenglow::tracer
