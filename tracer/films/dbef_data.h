#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "tracer/films/dbef.h"
#include "tracer/films/film_wavelengths.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"

namespace evenglow::tracer {

/// What a scattering film of kind `dbef` is made of.
struct DbefData {
  BsdfTable table;
  double wavelength_nm = kFilmWavelength;    ///< of light without a wavelength of its own
  std::optional<HemisphericalTable> totals;  ///< that the table is normalized to
  bool follows_wavelength = false;           ///< it is another film at another wavelength
  std::vector<std::string> remarks;

  /// The film at a wavelength; `axis`: rad.
  std::unique_ptr<const TabulatedDbef> surface(double lambda_nm, double axis) const;
};

/// Has this film data (`table` or `model`), or is it specular?
bool has_dbef_data(const core::ConfigNode& film);

/// Reads `table` (CSV, or HDF5 by its ending) with `hemispherical` and `wavelength_nm`, or tabulates `model`. Faults
/// are noted at the node; then empty.
///
/// | key of `model` | meaning (configs/data/README.md, "The model") | default |
/// | --- | --- | --- |
/// | sx, sy | widths of the narrow reflected lobe along the pass and the block axis, direction cosines | 0.07466,
/// 0.10178 | | s2, s3p, s3b | middle reflected lobe; wide one of pass and of block light | 0.17775, 0.33035, 0.57813 |
/// | p1_cd_m2, p3_cd_m2 | reflected pass light: narrow, wide | 286.76, 39.134 |
/// | b1_cd_m2, b2_cd_m2, b3_cd_m2 | reflected block light: narrow, middle, wide | 5686.5, 463.48, 10.952 |
/// | t1, t2, t3 | widths of the transmitted lobes | 0.09702, 0.13653, 0.52847 |
/// | a1_pass_cd_m2, a2_pass_cd_m2, a3_pass_cd_m2 | transmitted pass light | 3995.96, 1005.15, 5.9505 |
/// | a2_block_cd_m2, a3_block_cd_m2 | transmitted block light | 158.28, 2.137 |
/// | e0_lx | illuminance that the amplitudes belong to | 409.15 |
/// | absorption | share of light of either polarization | 0.015 |
/// | refractive_index | of the film's faces | 1.58 |
///
/// An empty map (`model: {}`) is the fitted DBEF.
std::optional<DbefData> read_dbef_data(const core::ConfigNode& film);

}  // namespace evenglow::tracer
