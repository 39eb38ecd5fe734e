#pragma once

#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/table_energy.h"

namespace evenglow::tracer {

/// R + T of any polarization (1) up to which a table without hemispherical totals is scaled down to 1; beyond it is
/// refused: the interpolation and noise of good measurements stay below, wrong units do not.
inline constexpr double kGreatestEnergy = 1.05;

/// Is tau 0 at every node?
bool is_black(const BsdfTable& table);

/// What no film of a run can be made of. Throws `core::ConfigError`, one fault: tau 0 everywhere.
void require_light(const BsdfTable& table);
/// Likewise: R + T of some polarization above `kGreatestEnergy` at a node of incidence. For Mueller matrices `table` is
/// their first row.
void require_energy(const BsdfTable& table, const std::vector<IncidenceEnergy>& energies);

}  // namespace evenglow::tracer
