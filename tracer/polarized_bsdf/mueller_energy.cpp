#include "tracer/polarized_bsdf/mueller_energy.h"

#include <cmath>

namespace evenglow::tracer {

std::vector<IncidenceEnergy> mueller_energies(const MuellerTable& table, double pass_index) {
  const BsdfTable::Axes& axes = table.axes();
  std::vector<IncidenceEnergy> energies = incidence_energies(table.intensities(), pass_index);
  std::vector<std::vector<OutgoingPoint>> points;
  points.reserve(axes.sigma.size());
  for (const double sigma : axes.sigma) points.push_back(outgoing_points(sigma));
  for (IncidenceEnergy& e : energies) {
    double circular = 0.0;  // T03
    for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
      if (!table.has(kind)) continue;
      const auto slice = table.slice(kind, axes.psi[e.psi], axes.sigma[e.sigma], axes.lambda_nm[e.lambda]);
      for (const OutgoingPoint& point : points[e.sigma]) {
        circular += point.weight * slice.at(point.direction.phi, point.direction.theta)(0, 3);
      }
    }
    const auto& [R, T] = e.kinds;
    e.greatest = 0.5 * (R.S + T.S) + std::hypot(0.5 * (R.x + T.x), 0.5 * (R.y + T.y), circular);
  }
  return energies;
}

}  // namespace evenglow::tracer
