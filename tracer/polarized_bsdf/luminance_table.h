#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"

namespace evenglow::tracer {

/// One reading of a goniometer: luminance of a lit film.
struct LuminanceRow {
  double psi = 0.0;         ///< rad, rotation of the film
  double theta = 0.0;       ///< rad, from the specular (direct) axis
  bool filtered = false;    ///< a linear polarizer before the film
  double filter = 0.0;      ///< rad, its pass axis; as psi counted from the plane of incidence
  double measured = 0.0;    ///< cd/m2
  double published = -1.0;  ///< cd/m2, simulated by who measured; negative: not given
};

/// Luminance of the light that a film reflects or transmits, under natural and filtered light: columns
/// `psi_deg,theta_deg,illumination,measured_cd_m2` and optionally `simulated_cd_m2`; illumination is `natural` or
/// `lpfA` with A the angle of the filter in whole degrees, 0 to 179.
struct LuminanceTable {
  std::string name;
  ScatterKind kind = ScatterKind::reflection;
  std::vector<LuminanceRow> rows;

  bool has_published() const;
  /// Throw `core::ConfigError`: everything `core::CsvNumbers` refuses, the same setting twice, no rows.
  static LuminanceTable read(const std::filesystem::path& file, ScatterKind kind);
  static LuminanceTable parse(std::string_view text, std::string name, ScatterKind kind);
};

/// Name of the illumination of a row as it stands in files: `natural`, `lpf45`.
std::string illumination_name(const LuminanceRow& row);

}  // namespace evenglow::tracer
