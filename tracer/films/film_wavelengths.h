#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "tracer/films/film.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"

/// Films made of tables: which wavelength of the data serves which light.
namespace evenglow::tracer {

/// Wavelength that films without a wavelength of their own hold for, nm.
inline constexpr double kFilmWavelength = 550.0;

/// What the keys `hemispherical` and `wavelength_nm` say.
struct TableKeys {
  std::optional<HemisphericalTable> totals;
  std::optional<double> wavelength_nm;  ///< every light sees the table at this wavelength
};
/// Empty: `hemispherical` is at fault.
std::optional<TableKeys> read_table_keys(const core::ConfigNode& film);

/// Does the film differ with the wavelength of light: several wavelengths in the table or its totals and none chosen by
/// the key?
bool follows_wavelength(const std::vector<double>& table_nm, const TableKeys& keys);

/// The wavelengths of a table and what happens beyond them, one sentence each.
std::vector<std::string> wavelength_remarks(const std::string& name, const std::vector<double>& table_nm,
                                            const TableKeys& keys);

/// Remarks (`FILE: text`) that name their file without its folder: results must not depend on where a run stands.
std::vector<std::string> without_folders(std::vector<std::string> remarks);

}  // namespace evenglow::tracer
