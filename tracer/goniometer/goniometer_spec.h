#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "tracer/films/dbef_data.h"
#include "tracer/films/film.h"
#include "tracer/polarized_bsdf/luminance_table.h"

namespace evenglow::tracer {

/// Linear polarizer between lamp and film.
struct GoniometerFilter {
  double k1 = 0.9, k2 = 0.0;   ///< principal transmittances; natural light keeps (k1 + k2) / 2
  std::vector<double> angles;  ///< rad, pass axis from the plane of incidence
};

/// Set-up of figure 6 of the DBEF paper: a lamp far away, a filter, the film turned by psi, a detector that looks at
/// the film. Map `goniometer` of the run file:
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | film | a film of any kind that scatters, as in `backlight.films`; `axis_deg` counts with psi | required |
/// | lamp.illuminance_lx | on the film, without the filter | 409.15 |
/// | lamp.sigma_deg | angle of incidence, [0, 85] | 0 |
/// | filter.k1, filter.k2 | principal transmittances of the filter | 0.9, 0 |
/// | filter.angles_deg | angles of the filter, [0, 180) | 0, 45, 90 |
/// | filter.offset_reflection_deg, filter.offset_transmission_deg | from psi to the film's axis of polarization, as the
/// scale of the filter sees it | 0 | | detector.theta_deg | from the specular (direct) axis, [0, 90) | 10, 20, 30, 40,
/// 50, 60 | | detector.acceptance_deg | half-angle of the cone that the detector averages over, (0, 10] | 0.5 | |
/// psi_deg | rotations of the film, [0, 360) | 0, 45, 90 | | measured.reflection, measured.transmission | luminance
/// tables to compare with (CSV) | none |
struct GoniometerSpec {
  Film film;
  std::optional<DbefData> data;  ///< of a film that has a table or a model, for its values without resampling
  double illuminance = 409.15;   ///< lx
  double sigma = 0.0;            ///< rad
  GoniometerFilter filter;
  double offset_reflection = 0.0, offset_transmission = 0.0;  ///< rad
  std::vector<double> theta, psi;                             ///< rad
  double acceptance = 0.0;                                    ///< rad
  std::vector<LuminanceTable> measured;                       ///< at most one of each kind
};

/// Faults are noted at the node.
GoniometerSpec read_goniometer(const core::ConfigNode& node);

}  // namespace evenglow::tracer
