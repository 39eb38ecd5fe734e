#pragma once

#include <cstddef>

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"

namespace evenglow::design {

/// Area (mm2) of the plate for each place of the lattice.
double lattice_place_area(const DotSpec& spec);

/// Largest diameter (mm) of a dot of the lattice: of the process, and what pitch and gap leave.
double greatest_lattice_diameter(const DotSpec& spec);

/// A dot at each place of the lattice in the free area, its area that of the place times the coverage there. Where that
/// asks for less than the least dot, the least dot stands at so many fewer places (error diffusion along the lattice).
DotStore lattice_dots(const DotSpec& spec, const CoverageMap& map);

}  // namespace evenglow::design
