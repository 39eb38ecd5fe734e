#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// `kind: carrier`: a birefringent carrier sheet (stretched polyester). Its retardance is many waves and differs over
/// the sheet and over the wavelengths of the light, so it mixes polarization states: a wave plate whose phase is
/// normally distributed, with the variance
///
///     (2 pi spread / lambda)^2 + (2 pi retardance bandwidth / lambda^2)^2.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | axis_deg | fast axis in [0, 180), from +x towards +y | 0 |
/// | retardance_nm | mean, at normal incidence and every wavelength, [0, 1e6] | 4000 |
/// | retardance_spread_nm | standard deviation over the sheet, [0, 1e6] | 100 |
/// | bandwidth_nm | standard deviation of the wavelengths that the traced one stands for, [0, 300] | 20 |
/// | refractive_index, birefringence | as of a retarder | 1.64, 0.05 |
/// | faces | `coated` or `fresnel` | fresnel |
Film make_carrier(const core::ConfigNode& node);

}  // namespace evenglow::tracer
