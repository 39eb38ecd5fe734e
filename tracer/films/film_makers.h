#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// Each reads the keys of its kind and makes the film. Faults are noted at the node; the film is then one that the
/// values in range give, or has neither surface nor sheet.
///
/// | kind | key | meaning | default |
/// | --- | --- | --- | --- |
/// | all | gap_mm | air below the film, mm | 0.05 |
/// | dbef, lpp | axis_deg | pass axis in [0, 180) from +x towards +y | 0 |
/// | dbef | table | polarized BSDF table (CSV or HDF5); without it the film is specular | none |
/// |  | hemispherical | with `table`: totals that the table is normalized to | none: its own |
/// |  | wavelength_nm | with `table`: every light sees it at this wavelength | the light's own, 550 |
/// |  | model | instead of `table`: map of the semi-empirical model's parameters (dbef_data.h); `{}` is the fitted DBEF
/// | none | |  | transmittance_pass, reflectance_pass | without `table` or `model`: along the pass axis, sum at most 1
/// | 1, 0 | |  | transmittance_block, reflectance_block | likewise along the block axis, sum at most 1 | 0, 1 | | lpp |
/// k1, k2 | transmittance along the pass and the block axis | 0.8596, 0.0004 | |  | reflectance | of any light; k1 +
/// reflectance at most 1 | 0.04 |
/// |  | angle_dependence | none, or sheet: longer path and projected dye of oblique rays (dichroic_sheet.h) | none |
/// |  | refractive_index | with `sheet`, instead of `reflectance`: smooth faces, [1.0001, 4] | none |
Film make_dbef(const core::ConfigNode& node);
Film make_lpp(const core::ConfigNode& node);

}  // namespace evenglow::tracer
