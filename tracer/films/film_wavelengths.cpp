#include "tracer/films/film_wavelengths.h"

#include <fmt/format.h>

namespace evenglow::tracer {

std::optional<TableKeys> read_table_keys(const core::ConfigNode& film) {
  TableKeys keys;
  keys.wavelength_nm = film.optional_number(
      {"wavelength_nm", "every light sees the table at this wavelength", {100, 10000, false, false}});
  const auto path =
      film.file({"hemispherical", "hemispherical totals that the table is normalized to (CSV)", std::string()});
  if (!film.has("hemispherical")) return keys;
  keys.totals = film.guarded("hemispherical", [&] { return HemisphericalTable::read(path); });
  if (!keys.totals) return std::nullopt;
  return keys;
}

bool follows_wavelength(const std::vector<double>& table_nm, const TableKeys& keys) {
  if (keys.wavelength_nm) return false;
  return table_nm.size() > 1 || (keys.totals && keys.totals->wavelengths_nm().size() > 1);
}

std::vector<std::string> wavelength_remarks(const std::string& name, const std::vector<double>& table_nm,
                                            const TableKeys& keys) {
  std::vector<std::string> remarks;
  const double first = table_nm.front(), last = table_nm.back();
  if (table_nm.size() == 1) {
    remarks.push_back(fmt::format("{}: data at {} nm alone, used at every wavelength", name, first));
  } else if (!keys.wavelength_nm) {
    remarks.push_back(fmt::format("{}: data at {} wavelengths from {} to {} nm; beyond these the nearest is used", name,
                                  table_nm.size(), first, last));
  } else if (*keys.wavelength_nm < first || *keys.wavelength_nm > last) {
    remarks.push_back(fmt::format("{}: wavelength_nm {} lies beyond the data ({} to {} nm); the nearest is used", name,
                                  *keys.wavelength_nm, first, last));
  }
  if (table_nm.size() > 1 && keys.totals && keys.totals->wavelengths_nm().size() < 2 && !keys.wavelength_nm) {
    remarks.push_back(
        fmt::format("{}: normalized to the same hemispherical totals at every wavelength (no column lambda_nm)", name));
  }
  return remarks;
}

std::vector<std::string> without_folders(std::vector<std::string> remarks) {
  for (std::string& remark : remarks) {
    const std::size_t slash = remark.substr(0, remark.find(": ")).rfind('/');
    if (slash != std::string::npos) remark.erase(0, slash + 1);
  }
  return remarks;
}

}  // namespace evenglow::tracer
