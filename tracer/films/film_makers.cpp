#include "tracer/films/film_makers.h"

#include <algorithm>

#include <fmt/format.h>

#include "tracer/films/dbef.h"
#include "tracer/films/dbef_data.h"
#include "tracer/films/dichroic_sheet.h"
#include "tracer/films/faced_body.h"
#include "tracer/films/film_keys.h"
#include "tracer/films/film_wavelengths.h"
#include "tracer/films/ideal_polarizer.h"
#include "tracer/films/lpp.h"

namespace evenglow::tracer {
namespace {

using core::Range;

void read_ideal_dbef(const core::ConfigNode& node, Film& film) {
  IdealPolarizer::Powers p;
  p.transmittance_pass = share(node, "transmittance_pass", "transmittance of light along the pass axis", 1.0);
  p.reflectance_pass = share(node, "reflectance_pass", "reflectance of light along the pass axis", 0.0);
  p.transmittance_block = share(node, "transmittance_block", "transmittance of light along the block axis", 0.0);
  p.reflectance_block = share(node, "reflectance_block", "reflectance of light along the block axis", 1.0);
  // A changed key must not make its defaulted partner a fault.
  if (!node.has("reflectance_block")) p.reflectance_block = std::min(p.reflectance_block, 1.0 - p.transmittance_block);
  if (!node.has("transmittance_pass")) p.transmittance_pass = std::min(p.transmittance_pass, 1.0 - p.reflectance_pass);
  require_sum(node, p.transmittance_pass, "transmittance_pass", p.reflectance_pass, "reflectance_pass");
  require_sum(node, p.transmittance_block, "transmittance_block", p.reflectance_block, "reflectance_block");
  film.surface = std::make_unique<IdealPolarizer>(p, film.axis, kDbefIndex);
}

void read_scattering_dbef(const core::ConfigNode& node, Film& film) {
  auto data = read_dbef_data(node);
  if (!data) return;
  auto surface = node.guarded(node.has("model") ? "model" : "table",
                              [&] { return data->surface(data->wavelength_nm, film.axis); });
  if (!surface) return;
  film.remarks = (*surface)->remarks();
  film.remarks.insert(film.remarks.end(), data->remarks.begin(), data->remarks.end());
  film.remarks = without_folders(std::move(film.remarks));
  film.surface = std::move(*surface);
  if (!data->follows_wavelength) return;
  film.at_wavelength = [data = std::move(*data), axis = film.axis](double lambda_nm) {
    return FilmOptics{data.surface(lambda_nm, axis), {}};
  };
}

/// Smooth faces of this index in place of `reflectance`.
void take_faces(const core::ConfigNode& node, double index, DichroicSheet::Spec& spec) {
  if (node.has("reflectance")) {
    node.fault_at("reflectance", "must not stand beside refractive_index, which gives the reflection of the faces");
    share(node, "reflectance", "reflectance of any light, polarization kept", 0.04);
  }
  spec.index = index;
  spec.reflectance.reset();
  const double most = greatest_through_faces(index);
  if (spec.k1 <= most) return;
  node.fault_at("k1", fmt::format("must be at most {:g}, what faces of refractive_index {:g} let through, got {:g}",
                                  most, index, spec.k1));
  spec.k1 = most;
}

/// `reflectance`, or `refractive_index`.
void read_lpp_faces(const core::ConfigNode& node, bool sheet, DichroicSheet::Spec& spec) {
  const auto index = node.optional_number(
      {"refractive_index", "instead of reflectance: smooth faces of this index", Range::closed(1.0001, 4)});
  if (index && sheet) {
    take_faces(node, *index, spec);
    return;
  }
  if (index) {
    node.fault_at("refractive_index", "must stand beside angle_dependence: sheet, got angle_dependence: none");
  }
  double reflectance = share(node, "reflectance", "reflectance of any light, polarization kept", LppSpec{}.reflectance);
  require_sum(node, spec.k1, "k1", reflectance, "reflectance");
  spec.reflectance = reflectance;
}

}  // namespace

Film make_dbef(const core::ConfigNode& node) {
  Film film = film_of("dbef", node);
  film.axis = axis_of(node);
  film.axis_index = kDbefIndex;
  if (has_dbef_data(node)) {
    read_scattering_dbef(node, film);
  } else {
    if (node.has("hemispherical")) {
      node.fault_at("hemispherical", "must stand beside the table that it normalizes, got no table");
    }
    // Absent, but to be named where a key is unknown.
    for (const char* key : {"table", "hemispherical"}) node.file({key, "CSV or HDF5 file", std::string()});
    node.map("model", "semi-empirical BSDF");
    read_ideal_dbef(node, film);
  }
  return film;
}

Film make_lpp(const core::ConfigNode& node) {
  Film film = film_of("lpp", node);
  film.axis = axis_of(node);
  const bool sheet = node.choice({"angle_dependence",
                                  "none: the same transmittances at every angle; sheet: those of a dyed sheet",
                                  {"none", "sheet"},
                                  "none"}) == "sheet";
  const LppSpec defaults;
  DichroicSheet::Spec spec;
  spec.axis = film.axis;
  spec.index = kLppIndex;
  spec.k1 = share(node, "k1", "transmittance of light along the pass axis, faces included", defaults.k1);
  spec.k2 = share(node, "k2", "transmittance of light along the block axis", defaults.k2);
  read_lpp_faces(node, sheet, spec);
  if (spec.k2 > spec.k1) {
    node.fault_at("k2", fmt::format("must be at most k1 = {:g}, got {:g}", spec.k1, spec.k2));
    spec.k2 = spec.k1;
  }
  film.axis_index = spec.index;
  if (sheet) {
    film.surface = std::make_unique<DichroicSheet>(spec);
  } else {
    film.surface =
        std::make_unique<IdealPolarizer>(lpp_surface({spec.k1, spec.k2, spec.reflectance.value_or(0.0), film.axis}));
  }
  return film;
}

}  // namespace evenglow::tracer
