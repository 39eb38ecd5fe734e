#include "tracer/films/diffuser_maker.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/diffuser.h"
#include "tracer/films/film_keys.h"
#include "tracer/films/film_wavelengths.h"
#include "tracer/films/haze.h"
#include "tracer/films/scatter_table.h"
#include "tracer/films/tabulated_diffuser.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr double kDefaultFwhm = 40.0;  // degrees

/// The width that `haze_astm` asks for.
std::optional<double> width_from_haze(const core::ConfigNode& node, double scattered) {
  const auto haze = node.optional_number({"haze_astm",
                                          "instead of fwhm_deg: haze as of ASTM D1003, the share of the transmitted "
                                          "light that deviates by more than 2.5 degrees at normal incidence",
                                          {0, 1, true, true}});
  if (!haze) return std::nullopt;
  if (node.has("fwhm_deg")) {
    node.fault_at("haze_astm", "must be left out where fwhm_deg is given, got both");
    return std::nullopt;
  }
  const auto fwhm = scattered > 0.0 ? fwhm_of_haze(*haze / scattered) : std::nullopt;
  if (!fwhm) {
    node.fault_at("haze_astm",
                  fmt::format("must be at most {:.4g}, what lobes of 1 to 150 degrees can give where the share haze = "
                              "{:g} is scattered, got {:g}",
                              scattered * gaussian_haze(150.0 * core::kRadPerDeg), scattered, *haze));
  }
  return fwhm;
}

void read_gaussian(const core::ConfigNode& node, Diffuser::Spec& spec) {
  const auto asked = width_from_haze(node, spec.haze);
  spec.fwhm = kDefaultFwhm * core::kRadPerDeg;
  if (asked) {
    spec.fwhm = asked;
  } else {
    spec.fwhm = node.number({"fwhm_deg", "full width at half maximum of the luminance of the lobe at normal incidence",
                             Range::closed(1, 150), kDefaultFwhm});
  }
}

void read_abg(const core::ConfigNode& node, Diffuser::Spec& spec) {
  Diffuser::Spec::Abg abg;
  abg.g = node.number({"abg_g", "exponent g of the ABg lobe A / (B + |beta - beta0|^g)", Range::closed(0.5, 6)});
  abg.b = node.number({"abg_b", "B of the ABg lobe; A follows from the totals", Range::positive(64)});
  const double width = std::pow(abg.b, 1.0 / abg.g);
  const double held = std::clamp(width, AbgLobe::kLeastWidth, AbgLobe::kLargestWidth);
  if (width < held * (1.0 - 1e-12) || width > held * (1.0 + 1e-12)) {
    node.fault_at("abg_b", fmt::format("must make abg_b^(1/abg_g), the half width in direction cosines, lie in [{:g}, "
                                       "{:g}], got {:g}",
                                       AbgLobe::kLeastWidth, AbgLobe::kLargestWidth, width));
    abg.b = std::pow(held, abg.g);
  }
  spec.abg = abg;
}

/// The totals that the table is normalized to: both keys or neither.
std::optional<TabulatedDiffuser::Totals> read_totals(const core::ConfigNode& node) {
  const auto T = node.optional_number(
      {"transmittance", "total transmittance that the table is normalized to", Range::closed(0, 1)});
  const auto R =
      node.optional_number({"reflectance", "total reflectance that the table is normalized to", Range::closed(0, 1)});
  if (!T && !R) return std::nullopt;
  if (!T || !R) {
    node.fault_at(T ? "transmittance" : "reflectance",
                  fmt::format("must stand beside {}, as a table is normalized to both or to neither, got one",
                              T ? "reflectance" : "transmittance"));
  }
  TabulatedDiffuser::Totals totals{T.value_or(0.0), R.value_or(0.0)};
  require_sum(node, totals.transmittance, "transmittance", totals.reflectance, "reflectance");
  return totals;
}

/// A kind of light that the table does not hold cannot be given a total.
void require_kinds(const core::ConfigNode& node, const BsdfTable& table, const TabulatedDiffuser::Totals& totals) {
  if (totals.transmittance > 0.0 && !table.has(ScatterKind::transmission)) {
    node.fault_at("transmittance", fmt::format("must be 0 for a table without btdf, got {:g}", totals.transmittance));
  }
  if (totals.reflectance > 0.0 && !table.has(ScatterKind::reflection)) {
    node.fault_at("reflectance", fmt::format("must be 0 for a table without brdf, got {:g}", totals.reflectance));
  }
}

void read_tabulated(const core::ConfigNode& node, Film& film) {
  const auto totals = read_totals(node);
  const double depolarization =
      share(node, "depolarization", "of scattered light: 0 keeps its polarization, 1 none", 0.0);
  const auto path = node.file({"table", "BSDF of the diffuser for natural light (CSV)"});
  if (path.empty()) return;
  const auto table = node.guarded("table", [&] { return read_scatter_table(path); });
  if (!table) return;
  if (totals) require_kinds(node, *table, *totals);
  auto surface = std::make_unique<TabulatedDiffuser>(*table, totals, depolarization);
  film.remarks = without_folders(surface->remarks());
  film.surface = std::move(surface);
}

void read_lobe(const core::ConfigNode& node, const std::string& lobe, Film& film) {
  Diffuser::Spec spec;
  spec.transmittance = share(node, "transmittance", "total transmittance", 0.9);
  spec.reflectance = share(node, "reflectance", "total reflectance; default: 0.1, or what transmittance leaves",
                           std::min(0.1, 1.0 - spec.transmittance));
  spec.haze = share(node, "haze", "share of the transmitted light that is scattered", 1.0);
  spec.depolarization = share(node, "depolarization", "of scattered light: 0 keeps its polarization, 1 none", 0.0);
  if (lobe == "gaussian") read_gaussian(node, spec);
  if (lobe == "abg") read_abg(node, spec);
  require_sum(node, spec.transmittance, "transmittance", spec.reflectance, "reflectance");
  film.surface = std::make_unique<Diffuser>(spec);
}

}  // namespace

Film make_diffuser(const core::ConfigNode& node) {
  Film film = film_of("diffuser", node);
  const std::string lobe =
      node.choice({"lobe", "shape of the scattered light", {"gaussian", "abg", "lambertian", "tabulated"}, "gaussian"});
  if (lobe == "tabulated") {
    read_tabulated(node, film);
  } else {
    read_lobe(node, lobe, film);
  }
  return film;
}

}  // namespace evenglow::tracer
