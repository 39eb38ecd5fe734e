#include "design/dots/dot_spec.h"

#include <fmt/core.h>

#include "core/base/units.h"

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;

constexpr Range kSize = Range::closed(0.5, 5000.0);     // um
constexpr Range kPlace = Range::closed(-10000, 10000);  // mm

void read_sizes(const ConfigNode& node, DotSpec& spec) {
  spec.diameter = node.number({"diameter_um", "of every dot in mode spacing (width of a square one)", kSize, 60.0});
  const auto limits = node.numbers({"diameters_um",
                                    "least and greatest diameter: limits of mode lattice, in mode both those of the "
                                    "least and the greatest density",
                                    kSize, 2, 2, std::vector<double>{30.0, 100.0}});
  if (limits.size() == 2) {
    spec.diameter_min = limits[0];
    spec.diameter_max = limits[1];
    if (!(limits[0] <= limits[1])) {
      node.fault_at("diameters_um", fmt::format("must be two numbers, least <= greatest, got [{:g}, {:g}]",
                                                limits[0] / core::kMmPerUm, limits[1] / core::kMmPerUm));
    }
  }
  spec.gap = node.number({"gap_um", "least clear distance between two dots", Range::closed(0, 1000), 10.0});
  spec.size_step = node.number(
      {"size_step_um", "diameters are whole multiples of it (one class of size each)", Range::closed(0.01, 100), 0.5});
  if (spec.size_step > 0.25 * spec.diameter_min && spec.mode != DotMode::spacing) {
    node.fault_at("size_step_um",
                  fmt::format("must be at most a quarter of the least diameter, {:g}, got {:g}",
                              0.25 * spec.diameter_min / core::kMmPerUm, spec.size_step / core::kMmPerUm));
  }
}

void read_lattice(const ConfigNode& node, DotSpec& spec) {
  spec.pitch =
      node.number({"pitch_um", "distance of neighboring places of the lattice", Range::closed(1, 10000), 120.0});
  const std::string kind = node.choice({"lattice", "places of mode lattice", {"square", "hexagonal"}, "square"});
  spec.lattice = kind == "square" ? DotLattice::square : DotLattice::hexagonal;
  spec.lattice_angle = node.number(
      {"lattice_angle_deg", "direction of a row of the lattice, from +x towards +y", Range::closed(-180, 180), 0.0});
}

void read_zones(const ConfigNode& node, DotSpec& spec) {
  const ConfigNode margins = node.map("margins", "edges of the plate without dots");
  const auto margin = [&](const char* key) {
    return margins.number({key, "width of the edge without dots", Range::closed(0, 10000), 0.0});
  };
  spec.margins = {margin("left_mm"), margin("right_mm"), margin("front_mm"), margin("back_mm")};
  for (const ConfigNode& zone : node.maps("keep_out", "zones without dots", 1000)) {
    const auto kind = zone.kind({"kind", "shape of the zone", {"rectangle", "circle"}});
    if (!kind) continue;
    const auto pair = [&](const char* key, const char* help) {
      auto values = zone.numbers({key, help, kPlace, 2, 2});
      if (values.size() != 2) values.assign(2, 0.0);
      return values;
    };
    if (*kind == "circle") {
      const auto center = pair("center_mm", "x and y of its center");
      spec.circles.push_back(
          {center[0], center[1], zone.number({"radius_mm", "radius of the zone", Range::closed(0.001, 10000)})});
      continue;
    }
    const auto x = pair("x_mm", "from and to, along x"), y = pair("y_mm", "from and to, along y");
    if (!(x[0] < x[1])) zone.fault_at("x_mm", fmt::format("must be from < to, got [{:g}, {:g}]", x[0], x[1]));
    if (!(y[0] < y[1])) zone.fault_at("y_mm", fmt::format("must be from < to, got [{:g}, {:g}]", y[0], y[1]));
    spec.rectangles.push_back({x[0], x[1], y[0], y[1]});
  }
}

void read_surroundings(const ConfigNode& node, DotSpec& spec) {
  const auto pitch = node.numbers({"panel_pitch_um", "pixel pitch of the panel along its x and y; left out: no panel",
                                   Range::closed(1, 10000), 2, 2, std::vector<double>{}});
  const double angle =
      node.number({"panel_angle_deg", "direction of the panel's x, from +x towards +y", Range::closed(-180, 180), 0.0});
  if (pitch.size() == 2) spec.panel = GratingSpec{pitch[0], pitch[1], angle};
  spec.viewing_distance =
      node.number({"viewing_mm", "distance of the eye, for beats that it sees", Range::closed(50, 10000), 350.0});
  const ConfigNode process = node.map("process", "what the maker's process does to the dots beyond the drawing");
  spec.process.bias = process.number({"bias_um", "every diameter grows by it", Range::closed(-1000, 1000), 0.0});
  spec.process.size_spread =
      process.number({"size_spread_um", "standard deviation of the diameter", Range::closed(0, 1000), 0.0});
  spec.process.position_spread =
      process.number({"position_spread_um", "standard deviation of x and of y", Range::closed(0, 1000), 0.0});
}

}  // namespace

DotSpec read_dots(const ConfigNode& node, core::Footprint default_footprint) {
  DotSpec spec;
  const std::string mode = node.choice({"mode",
                                        "spacing: one size, blue noise; lattice: one pitch, the size varies; both: "
                                        "blue noise of varying size",
                                        {"spacing", "lattice", "both"},
                                        "spacing"});
  spec.mode = mode == "spacing" ? DotMode::spacing : mode == "lattice" ? DotMode::lattice : DotMode::both;
  read_sizes(node, spec);
  read_lattice(node, spec);
  const bool square = default_footprint == core::Footprint::square;
  spec.footprint = node.choice({"footprint",
                                "outline of a dot; default: that of the pattern's shape",
                                {"round", "square"},
                                square ? "square" : "round"}) == "square"
                       ? core::Footprint::square
                       : core::Footprint::round;
  spec.angle = node.number({"angle_deg", "direction of every dot's own axis", Range::closed(-180, 180), 0.0});
  spec.seed = static_cast<std::uint64_t>(node.integer({"seed", "of the random numbers", 0, 1'000'000'000'000, 1}));
  spec.accept_shortfall = node.boolean(
      {"accept_shortfall", "place what the limits allow where the density asks for more, and tell it", false});
  read_zones(node, spec);
  read_surroundings(node, spec);
  return spec;
}

}  // namespace evenglow::design
