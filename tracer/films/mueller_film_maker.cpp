#include "tracer/films/mueller_film_maker.h"

#include <memory>
#include <utility>

#include "tracer/films/dbef.h"
#include "tracer/films/film_keys.h"
#include "tracer/films/film_wavelengths.h"
#include "tracer/films/mueller_film.h"
#include "tracer/polarized_bsdf/mueller_energy.h"
#include "tracer/polarized_bsdf/table_limits.h"

namespace evenglow::tracer {
namespace {

/// Copied with the film's function of wavelength, so all of it is values.
struct MuellerData {
  MuellerTable table;
  TableKeys keys;
  double axis = 0.0;

  std::unique_ptr<const TabulatedMueller> surface(double lambda_nm) const {
    std::optional<HemisphericalTable> totals;
    if (keys.totals) totals = keys.totals->at_wavelength(lambda_nm);
    return std::make_unique<TabulatedMueller>(table, lambda_nm, totals ? &*totals : nullptr, axis);
  }
};

std::optional<AngleOrigin> frames_of(const core::ConfigNode& node) {
  const std::string frames = node.choice({"frames",
                                          "that the matrices are counted in; file: as its comment says",
                                          {"file", "film", "laboratory"},
                                          "file"});
  if (frames == "file") return std::nullopt;
  return frames == "film" ? AngleOrigin::film : AngleOrigin::laboratory;
}

}  // namespace

Film make_mueller_table(const core::ConfigNode& node) {
  Film film = film_of("mueller_table", node);
  film.axis = axis_of(node);
  film.axis_index = kDbefIndex;
  const auto path = node.file({"table", "Mueller matrices of the film (CSV or HDF5)"});
  const auto frames = frames_of(node);
  auto keys = read_table_keys(node);
  if (path.empty() || !keys) return film;
  auto table = node.guarded("table", [&] {
    MuellerTable read = MuellerTable::read(path, frames);
    require_light(read.intensities());
    if (!keys->totals) require_energy(read.intensities(), mueller_energies(read, kDbefIndex));
    return read;
  });
  if (!table) return film;
  MuellerData data{std::move(*table), std::move(*keys), film.axis};
  const std::vector<double> wavelengths = data.table.axes().lambda_nm;
  auto surface = node.guarded("table", [&] { return data.surface(data.keys.wavelength_nm.value_or(kFilmWavelength)); });
  if (!surface) return film;
  film.remarks = (*surface)->remarks();
  for (std::string& remark : wavelength_remarks(data.table.intensities().name(), wavelengths, data.keys)) {
    film.remarks.push_back(std::move(remark));
  }
  film.remarks = without_folders(std::move(film.remarks));
  film.surface = std::move(*surface);
  if (follows_wavelength(wavelengths, data.keys)) {
    film.at_wavelength = [data = std::move(data)](double lambda_nm) { return FilmOptics{data.surface(lambda_nm), {}}; };
  }
  return film;
}

}  // namespace evenglow::tracer
