#include "tracer/films/dbef_data.h"

#include <utility>

#include "tracer/polarized_bsdf/lobe_table.h"
#include "tracer/polarized_bsdf/table_energy.h"
#include "tracer/polarized_bsdf/table_limits.h"

namespace evenglow::tracer {
namespace {

std::optional<DbefData> read_table(const core::ConfigNode& film) {
  const auto path = film.file(
      {"table", "polarized BSDF table (CSV or HDF5); without it or a model the film is specular", std::string()});
  auto keys = read_table_keys(film);
  if (!keys) return std::nullopt;
  auto table = film.guarded("table", [&] {
    BsdfTable read = BsdfTable::read(path);
    require_light(read);
    if (!keys->totals) require_energy(read, incidence_energies(read, kDbefIndex));
    return read;
  });
  if (!table) return std::nullopt;
  const std::vector<double>& wavelengths = table->axes().lambda_nm;
  const bool follows = follows_wavelength(wavelengths, *keys);
  std::vector<std::string> remarks = wavelength_remarks(table->name(), wavelengths, *keys);
  return DbefData{std::move(*table), keys->wavelength_nm.value_or(kFilmWavelength), std::move(keys->totals), follows,
                  std::move(remarks)};
}

std::optional<DbefData> read_model(const core::ConfigNode& film) {
  const core::ConfigNode node = film.map("model", "semi-empirical BSDF; an empty map is the fitted DBEF");
  LobeParameters parameters;
  for (const LobeParameter& p : lobe_parameters()) {
    parameters.*p.member = node.number({p.key, p.help, core::Range::closed(p.least, p.greatest), parameters.*p.member});
  }
  return film.guarded("model", [&] {
    const LobeModel model(parameters);
    return DbefData{lobe_table(model), kFilmWavelength, lobe_hemispherical(model), false, {}};
  });
}

}  // namespace

std::unique_ptr<const TabulatedDbef> DbefData::surface(double lambda_nm, double axis) const {
  std::optional<HemisphericalTable> here;
  if (totals) here = totals->at_wavelength(lambda_nm);
  return std::make_unique<TabulatedDbef>(table, lambda_nm, here ? &*here : nullptr, axis);
}

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
