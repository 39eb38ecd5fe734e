#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"
#include "tracer/films/wave_plate.h"

namespace evenglow::tracer {

/// How the retardance of a film depends on the wavelength: in nm, that at `design_wavelength` times c(lambda) /
/// c(design_wavelength) with Cauchy's c = 1 + B / lambda^2, B from `ratio` = c(450 nm) / c(550 nm).
struct RetardanceDispersion {
  double design_wavelength = 550.0;  ///< nm
  double ratio = 1.0;                ///< in [0.8, 1.3]

  /// c(lambda) / c(design_wavelength), above 0 for lambda from 300 nm.
  double factor(double wavelength_nm) const;
};

/// Phase (rad) of a retardance in nm, 2 pi retardance / wavelength.
double retardance_phase(double retardance_nm, double wavelength_nm);

/// Reads the keys of a wave plate that do not tell how much it retards: `axis_deg` (the fast axis), `refractive_index`,
/// `birefringence`, `faces`.
WavePlate::Spec read_wave_plate(const core::ConfigNode& node, const WavePlate::Spec& defaults);

/// `kind: retarder`. Its surface holds for 550 nm; `at_wavelength` makes it for others.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | axis_deg | fast axis in [0, 180), from +x towards +y | 0 |
/// | plate | `quarter` or `half` wave at the design wavelength | quarter |
/// | retardance_nm, retardance_deg | instead of `plate`: at the design wavelength | none |
/// | design_wavelength_nm | [300, 2000] | 550 |
/// | dispersion_ratio | retardance in nm at 450 over that at 550 nm, [0.8, 1.3] | 1 |
/// | refractive_index | ordinary index, [1.0001, 4] | 1.59 |
/// | birefringence | extraordinary less ordinary index, [-0.3, 0.3]; above 0: optic axis slow | 0.003 |
/// | faces | `coated`: no reflection; `fresnel`: smooth faces | coated |
Film make_retarder(const core::ConfigNode& node);

}  // namespace evenglow::tracer
