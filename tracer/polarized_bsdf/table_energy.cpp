#include "tracer/polarized_bsdf/table_energy.h"

#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

constexpr int kU = 64;
constexpr int kPhi = 72;

}  // namespace

std::vector<OutgoingPoint> outgoing_points(double sigma) {
  const double c2 = std::cos(sigma) * std::cos(sigma);
  std::vector<OutgoingPoint> points;
  for (int k = 0; k < kPhi; ++k) {
    const double phi = 2.0 * core::kPi * (k + 0.5) / kPhi;
    const double r = horizon_distance(std::sin(sigma), c2, std::cos(phi), std::sin(phi));
    for (int i = 0; i < kU; ++i) {
      const double low = static_cast<double>(i) / kU;
      const double high = static_cast<double>(i + 1) / kU;
      const double ring = 0.5 * (std::pow(high, 4) - std::pow(low, 4));  // integral of 2 u^3
      points.push_back({seen_from_axis(sigma, 0.5 * (low + high), phi), ring * r * r * 2.0 * core::kPi / kPhi});
    }
  }
  return points;
}

std::vector<IncidenceEnergy> incidence_energies(const BsdfTable& table, double pass_index) {
  const BsdfTable::Axes& axes = table.axes();
  std::vector<std::vector<OutgoingPoint>> points;
  points.reserve(axes.sigma.size());
  for (const double sigma : axes.sigma) points.push_back(outgoing_points(sigma));
  std::vector<IncidenceEnergy> energies;
  for (std::size_t l = 0; l < axes.lambda_nm.size(); ++l) {
    for (std::size_t p = 0; p < axes.psi.size(); ++p) {
      for (std::size_t s = 0; s < axes.sigma.size(); ++s) {
        IncidenceEnergy e{p, s, l, {}};
        for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
          if (!table.has(kind)) continue;
          const auto slice = table.slice(kind, axes.psi[p], axes.sigma[s], axes.lambda_nm[l]);
          HemisphereIntegral& sum = e.kinds[static_cast<std::size_t>(kind)];
          for (const OutgoingPoint& point : points[s]) {
            const BsdfTable::Value value = slice.at(point.direction.phi, point.direction.theta);
            sum.S += point.weight * value.S;
            sum.x += point.weight * value.S * value.x;
            sum.y += point.weight * value.S * value.y;
          }
        }
        // The pass axis as the ray sees it, less psi: the table counts from the film.
        const double psi = axes.psi[p];
        const AxisAngle axis = pass_axis(std::cos(psi), std::sin(psi), std::sin(axes.sigma[s]), pass_index);
        const double c = axis.cos2 * std::cos(2.0 * psi) + axis.sin2 * std::sin(2.0 * psi);
        const double q = axis.sin2 * std::cos(2.0 * psi) - axis.cos2 * std::sin(2.0 * psi);
        const auto& [R, T] = e.kinds;
        e.reflectance_pass = R.along(c, q);
        e.reflectance_block = R.along(-c, -q);
        e.transmittance_pass = T.along(c, q);
        e.transmittance_block = T.along(-c, -q);
        e.greatest = 0.5 * (R.S + T.S + std::hypot(R.x + T.x, R.y + T.y));
        energies.push_back(e);
      }
    }
  }
  return energies;
}

}  // namespace evenglow::tracer
