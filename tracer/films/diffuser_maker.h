#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// Kind `diffuser` (docs/diffusers.md).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | lobe | gaussian, abg, lambertian or tabulated | gaussian |
/// | transmittance, reflectance | totals, sum at most 1 | 0.9, 0.1; tabulated: the table's |
/// | haze | not tabulated: share of the transmitted light that is scattered | 1 |
/// | depolarization | of scattered light, [0, 1] | 0 |
/// | fwhm_deg | gaussian: full width at half maximum of the luminance at normal incidence, [1, 150] | 40 |
/// | haze_astm | gaussian, instead of fwhm_deg: haze.h, below `haze` | none |
/// | abg_b, abg_g | abg: B and g (abg_lobe.h) | required |
/// | table | tabulated: CSV (scatter_table.h) | required |
Film make_diffuser(const core::ConfigNode& node);

}  // namespace evenglow::tracer
