#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// `kind: mueller_table`: scattering film from a table of Mueller matrices (mueller_film.h). Faults are noted at the
/// node.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | table | m00 ... m33 at every node, CSV or HDF5 (docs/films.md) | required |
/// | frames | that the matrices are counted in: film, laboratory, or file: as its comment says | file |
/// | hemispherical | totals that the table is normalized to (CSV) | none: its own |
/// | wavelength_nm | every light sees the table at this wavelength | the light's own |
/// | axis_deg | film axis in [0, 180) from +x towards +y | 0 |
/// | gap_mm | air below the film | 0.05 |
Film make_mueller_table(const core::ConfigNode& node);

}  // namespace evenglow::tracer
