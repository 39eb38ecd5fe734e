#include "tracer/films/sheet.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/film_keys.h"
#include "tracer/films/film_wavelengths.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {
namespace {

using core::Range;

const char* const kNoMaterial = "none";

/// Name of the material; `kNoMaterial` if the sheet has an index of its own.
std::string read_material(const core::ConfigNode& node, DielectricSheet& sheet) {
  std::vector<std::string> names{kNoMaterial};
  names.insert(names.end(), material_names().begin(), material_names().end());
  std::string name = node.choice({"material", "material of the sheet, instead of an index", names, kNoMaterial});
  if (name != kNoMaterial && node.has("refractive_index")) {
    node.fault_at("material", "must be left out where refractive_index is given, got both");
    name = kNoMaterial;
  }
  if (name == kNoMaterial) {
    sheet.refractive_index = node.number({"refractive_index", "of the sheet", Range::closed(1.0001, 4), 1.5});
    return name;
  }
  const Material values = material(name, kFilmWavelength);
  sheet.refractive_index = values.refractive_index;
  sheet.absorption = values.absorption;
  return name;
}

void read_scattering(const core::ConfigNode& node, DielectricSheet& sheet) {
  VolumeScattering bulk;
  bulk.coefficient =
      node.number({"scattering_per_mm", "mean scatters per mm in the bulk; 0: clear", Range::closed(0, 1e4), 0.0});
  if (bulk.coefficient <= 0.0) {
    for (const char* key : {"anisotropy", "depolarization"}) {
      if (node.has(key)) node.fault_at(key, "must stand beside scattering_per_mm above 0, got a sheet that is clear");
    }
  }
  bulk.anisotropy =
      node.number({"anisotropy", "mean cosine of the angle of a scatter (g)", Range::closed(-0.99, 0.999), 0.9});
  bulk.depolarization = share(node, "depolarization", "share of the polarization that one scatter takes", 1.0);
  if (bulk.coefficient * sheet.thickness > kMostScatters) {
    node.fault_at("scattering_per_mm",
                  fmt::format("must be at most {:g} for this thickness ({:g} mean free paths), got {:g}",
                              kMostScatters / sheet.thickness, kMostScatters, bulk.coefficient));
    bulk.coefficient = 0.0;
  }
  if (bulk.coefficient > 0.0) sheet.scattering = bulk;
}

}  // namespace

Film make_sheet(const core::ConfigNode& node) {
  Film film = film_of("sheet", node);
  DielectricSheet sheet;
  const std::string name = read_material(node, sheet);
  sheet.absorption =
      node.number({"absorption_per_m", "bulk absorption coefficient; default: of the material, 0 without",
                   Range::closed(0, 1e6), sheet.absorption * core::kMmPerM});
  sheet.thickness = node.number({"thickness_mm", "of the sheet", Range::closed(0.001, 100), 0.1});
  read_scattering(node, sheet);
  film.sheet = sheet;
  if (name != kNoMaterial) {
    film.at_wavelength = [sheet, name](double wavelength) {
      DielectricSheet there = sheet;
      there.refractive_index = material(name, wavelength).refractive_index;
      return FilmOptics{nullptr, there};
    };
  }
  return film;
}

}  // namespace evenglow::tracer
