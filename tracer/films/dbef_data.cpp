#include "tracer/films/dbef_data.h"

#include <utility>

#include "tracer/polarized_bsdf/lobe_table.h"

namespace evenglow::tracer {
namespace {

std::optional<DbefData> read_table(const core::ConfigNode& film) {
  const auto path =
      film.file({"table", "polarized BSDF table (CSV); without it or a model the film is specular", std::string()});
  const double wavelength =
      film.number({"wavelength_nm", "wavelength that the table is read at", {100, 10000, false, false}, 550.0});
  std::optional<HemisphericalTable> totals;
  if (film.has("hemispherical")) {
    const auto totals_path = film.file({"hemispherical", "hemispherical totals that the table is normalized to (CSV)"});
    totals = film.guarded("hemispherical", [&] { return HemisphericalTable::read(totals_path); });
    if (!totals) return std::nullopt;
  }
  auto table = film.guarded("table", [&] { return BsdfTable::read(path); });
  if (!table) return std::nullopt;
  return DbefData{std::move(*table), wavelength, std::move(totals)};
}

std::optional<DbefData> read_model(const core::ConfigNode& film) {
  const core::ConfigNode node = film.map("model", "semi-empirical BSDF; an empty map is the fitted DBEF");
  LobeParameters parameters;
  for (const LobeParameter& p : lobe_parameters()) {
    parameters.*p.member = node.number({p.key, p.help, core::Range::closed(p.least, p.greatest), parameters.*p.member});
  }
  return film.guarded("model", [&] {
    const LobeModel model(parameters);
    return DbefData{lobe_table(model), 550.0, lobe_hemispherical(model)};
  });
}

}  // namespace

bool has_dbef_data(const core::ConfigNode& film) {
  return film.has("table") || film.has("model");
}

std::optional<DbefData> read_dbef_data(const core::ConfigNode& film) {
  if (!film.has("model")) return read_table(film);
  for (const char* key : {"table", "hemispherical"}) {
    if (!film.has(key)) continue;
    film.fault_at(key, "must not stand beside a model, got both");
    film.file({key, "CSV file"});
  }
  return read_model(film);
}

}  // namespace evenglow::tracer
