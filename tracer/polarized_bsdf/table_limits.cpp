#include "tracer/polarized_bsdf/table_limits.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {

bool is_black(const BsdfTable& table) {
  return table.largest() == 0.0;
}

void require_light(const BsdfTable& table) {
  if (!is_black(table)) return;
  throw core::ConfigError(core::Fault{table.name(), 0, 0, {}, "must reflect or transmit, got tau 0 everywhere"});
}

void require_energy(const BsdfTable& table, const std::vector<IncidenceEnergy>& energies) {
  const auto worst = std::ranges::max_element(energies, {}, &IncidenceEnergy::greatest);
  if (worst == energies.end() || worst->greatest <= kGreatestEnergy) return;
  const BsdfTable::Axes& axes = table.axes();
  throw core::ConfigError(core::Fault{
      table.name(),
      0,
      0,
      {},
      fmt::format("must give R + T of at most {} for any polarization (or stand beside hemispherical), got {:.4g} at "
                  "psi {:.6g} sigma {:.6g} lambda {}",
                  kGreatestEnergy, worst->greatest, axes.psi[worst->psi] / core::kRadPerDeg,
                  axes.sigma[worst->sigma] / core::kRadPerDeg, axes.lambda_nm[worst->lambda])});
}

}  // namespace evenglow::tracer
