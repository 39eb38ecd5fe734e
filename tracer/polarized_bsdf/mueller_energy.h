#pragma once

#include <vector>

#include "tracer/polarized_bsdf/mueller_table.h"
#include "tracer/polarized_bsdf/table_energy.h"

namespace evenglow::tracer {

/// As `incidence_energies` of the first rows; `greatest` is then R + T of the polarization that has most over the whole
/// Poincare sphere, circular light included: T00 + |(T01, T02, T03)| for the integral T of M over the hemisphere.
std::vector<IncidenceEnergy> mueller_energies(const MuellerTable& table, double pass_index);

}  // namespace evenglow::tracer
