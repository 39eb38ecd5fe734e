#include "tracer/films/film_makers.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/dbef.h"
#include "tracer/films/dbef_data.h"
#include "tracer/films/diffuser.h"
#include "tracer/films/ideal_polarizer.h"
#include "tracer/films/lpp.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr double kDefaultGap = 0.05;  // mm

Film film_of(std::string kind, const core::ConfigNode& node) {
  Film film;
  film.kind = std::move(kind);
  film.gap = node.number({"gap_mm", "air below the film", {0.001, 100.0, false, false}, kDefaultGap});
  return film;
}

double axis_of(const core::ConfigNode& node) {
  return node.number({"axis_deg", "pass axis, counted from +x towards +y", {0.0, 180.0, false, true}, 0.0});
}

double share(const core::ConfigNode& node, std::string_view key, std::string_view help, double fallback) {
  return node.number({key, help, Range::closed(0, 1), fallback});
}

/// Notes a fault and lowers `part` if the two come to more than the whole.
void require_sum(const core::ConfigNode& node, double whole, std::string_view whole_key, double& part,
                 std::string_view part_key) {
  if (whole + part <= 1.0 + 1e-12) return;
  node.fault_at(part_key, fmt::format("must be at most 1 - {} = {:g}, got {:g}", whole_key, 1.0 - whole, part));
  part = 1.0 - whole;
}

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

/// Remarks (`FILE: text`) that name their file without its folder: results must not depend on where a run stands.
std::vector<std::string> without_folders(std::vector<std::string> remarks) {
  for (std::string& remark : remarks) {
    const std::size_t slash = remark.substr(0, remark.find(": ")).rfind('/');
    if (slash != std::string::npos) remark.erase(0, slash + 1);
  }
  return remarks;
}

void read_scattering_dbef(const core::ConfigNode& node, Film& film) {
  const auto data = read_dbef_data(node);
  if (!data) return;
  auto surface = node.guarded(node.has("model") ? "model" : "table", [&] {
    return std::make_unique<TabulatedDbef>(data->table, data->wavelength_nm, data->totals ? &*data->totals : nullptr,
                                           film.axis);
  });
  if (!surface) return;
  film.remarks = without_folders((*surface)->remarks());
  film.surface = std::move(*surface);
}

}  // namespace

Film make_dbef(const core::ConfigNode& node) {
  Film film = film_of("dbef", node);
  film.axis = axis_of(node);
  if (has_dbef_data(node)) {
    read_scattering_dbef(node, film);
  } else {
    if (node.has("hemispherical")) {
      node.fault_at("hemispherical", "must stand beside the table that it normalizes, got no table");
      node.file({"hemispherical", "hemispherical totals that the table is normalized to (CSV)"});
    }
    read_ideal_dbef(node, film);
  }
  return film;
}

Film make_lpp(const core::ConfigNode& node) {
  Film film = film_of("lpp", node);
  film.axis = axis_of(node);
  LppSpec spec;
  spec.axis = film.axis;
  spec.k1 = share(node, "k1", "transmittance of light along the pass axis, faces included", spec.k1);
  spec.k2 = share(node, "k2", "transmittance of light along the block axis", spec.k2);
  spec.reflectance = share(node, "reflectance", "reflectance of any light, polarization kept", spec.reflectance);
  require_sum(node, spec.k1, "k1", spec.reflectance, "reflectance");
  if (spec.k2 > spec.k1) {
    node.fault_at("k2", fmt::format("must be at most k1 = {:g}, got {:g}", spec.k1, spec.k2));
    spec.k2 = spec.k1;
  }
  film.surface = std::make_unique<IdealPolarizer>(lpp_surface(spec));
  return film;
}

Film make_diffuser(const core::ConfigNode& node) {
  Film film = film_of("diffuser", node);
  Diffuser::Spec spec;
  spec.transmittance = share(node, "transmittance", "total transmittance", 0.9);
  spec.reflectance = share(node, "reflectance", "total reflectance; default: 0.1, or what transmittance leaves",
                           std::min(0.1, 1.0 - spec.transmittance));
  spec.haze = share(node, "haze", "share of the transmitted light that is scattered", 1.0);
  spec.depolarization = share(node, "depolarization", "of scattered light: 0 keeps its polarization, 1 none", 0.0);
  const std::string lobe =
      node.choice({"lobe", "shape of the scattered light", {"gaussian", "lambertian"}, "gaussian"});
  if (lobe == "gaussian") {
    spec.fwhm = node.number({"fwhm_deg", "full width at half maximum of the luminance of the lobe at normal incidence",
                             Range::closed(1, 150), 40.0});
  }
  require_sum(node, spec.transmittance, "transmittance", spec.reflectance, "reflectance");
  film.surface = std::make_unique<Diffuser>(spec);
  return film;
}

Film make_sheet(const core::ConfigNode& node) {
  Film film = film_of("sheet", node);
  DielectricSheet sheet;
  sheet.refractive_index = node.number({"refractive_index", "of the sheet", Range::closed(1.0001, 4), 1.5});
  sheet.absorption = node.number({"absorption_per_m", "bulk absorption coefficient", Range::closed(0, 1e6), 0.0});
  sheet.thickness = node.number({"thickness_mm", "of the sheet", Range::closed(0.001, 100), 0.1});
  film.sheet = sheet;
  return film;
}

}  // namespace evenglow::tracer
