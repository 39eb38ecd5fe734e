#include "tracer/films/bef_maker.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/bef.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr double kWavelength = 550.0;  // nm
constexpr double kWidestTip = 0.99;    // share of the pitch
const char* const kNoMaterial = "none";

PrismProfile::Shape read_profile(const core::ConfigNode& node) {
  PrismProfile::Shape shape;
  shape.apex = node.number({"apex_deg", "angle between the two facets of a prism", Range::closed(20, 170), 90.0});
  shape.pitch = node.number({"pitch_um", "width of a prism", Range::closed(0.1, 10000), 50.0});
  shape.tip_flat = node.number({"tip_flat_um", "width of the flat tip; 0: sharp", Range::closed(0, 10000), 0.0});
  shape.tip_radius = node.number({"tip_radius_um", "radius of the round tip; 0: sharp", Range::closed(0, 10000), 0.0});
  if (shape.tip_flat > 0.0 && shape.tip_radius > 0.0) {
    node.fault_at("tip_radius_um", "must be left out where tip_flat_um is given, got both");
    shape.tip_radius = 0.0;
  }
  const double widest = kWidestTip * shape.pitch;
  const double width_per_radius = 2.0 * std::cos(0.5 * shape.apex);
  if (shape.tip_flat > widest) {
    node.fault_at("tip_flat_um", fmt::format("must be at most {:g} for this pitch, got {:g}", widest / core::kMmPerUm,
                                             shape.tip_flat / core::kMmPerUm));
    shape.tip_flat = widest;
  }
  if (shape.tip_radius * width_per_radius > widest) {
    node.fault_at("tip_radius_um",
                  fmt::format("must be at most {:g} for this pitch and apex, got {:g}",
                              widest / width_per_radius / core::kMmPerUm, shape.tip_radius / core::kMmPerUm));
    shape.tip_radius = widest / width_per_radius;
  }
  return shape;
}

/// Name of the material, `kNoMaterial` if the film has an index of its own.
std::string read_optics(const core::ConfigNode& node, PrismFilmSpec& spec) {
  std::vector<std::string> names{kNoMaterial};
  names.insert(names.end(), material_names().begin(), material_names().end());
  std::string name = node.choice({"material", "material of the film, instead of an index", names, kNoMaterial});
  if (name == kNoMaterial || node.has("refractive_index")) {
    if (name != kNoMaterial) node.fault_at("material", "must be left out where refractive_index is given, got both");
    spec.refractive_index = node.number({"refractive_index", "of the film", Range::closed(1.0001, 4), 1.58});
    name = kNoMaterial;
  } else {
    const Material values = material(name, kWavelength);
    spec.refractive_index = values.refractive_index;
    spec.absorption = values.absorption;
  }
  spec.absorption = node.number({"absorption_per_m", "bulk absorption; default: that of the material, 0 without",
                                 Range::closed(0, 1e6), spec.absorption * core::kMmPerM});
  return name;
}

}  // namespace

Film make_bef(const core::ConfigNode& node) {
  Film film;
  film.kind = "bef";
  film.gap = node.number({"gap_mm", "air below the film", {0.001, 100.0, false, false}, 0.05});
  PrismFilmSpec spec;
  spec.profile = read_profile(node);
  spec.base = node.number({"base_um", "from the flat face to the valleys", Range::closed(0, 10000), 125.0});
  const std::string name = read_optics(node, spec);
  film.axis = spec.axis =
      node.number({"axis_deg", "direction of the grooves, counted from +x towards +y", {0.0, 180.0, false, true}, 0.0});
  spec.inverted = node.boolean({"inverted", "prisms face the plate (turning film)", false});
  film.surface = std::make_unique<PrismFilm>(spec);
  if (name != kNoMaterial) {
    // The bulk loss is held: the materials have one value for all wavelengths.
    film.at_wavelength = [spec, name](double wavelength) {
      PrismFilmSpec there = spec;
      there.refractive_index = material(name, wavelength).refractive_index;
      return FilmOptics{std::make_unique<PrismFilm>(there), std::nullopt};
    };
  }
  return film;
}

}  // namespace evenglow::tracer
