#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {

/// Integral over the outgoing hemisphere of S cos(theta) and of D (cos 2 delta, sin 2 delta) cos(theta), dimensionless.
/// Light polarized along an axis at the double angle (c, s) from the film's pass axis sends (S - x c - y s) / 2 there.
struct HemisphereIntegral {
  double S = 0.0, x = 0.0, y = 0.0;
  double along(double c, double s) const { return 0.5 * (S - x * c - y * s); }
};

/// A direction of the quadrature below, with its projected solid angle.
struct OutgoingPoint {
  AxisDirection direction;
  double weight = 0.0;
};
/// Midpoint rule on 64 x 72 points in the coordinates of outgoing_polar.h; `sigma` in rad.
std::vector<OutgoingPoint> outgoing_points(double sigma);

/// What a table reflects and transmits into the whole hemisphere at one incidence, by the interpolation of `BsdfTable`,
/// cut at the horizon (`outgoing_points`).
struct IncidenceEnergy {
  std::size_t psi = 0, sigma = 0, lambda = 0;  ///< indices into the table's axes
  std::array<HemisphereIntegral, 2> kinds;     ///< by ScatterKind
  double reflectance_pass = 0.0, transmittance_pass = 0.0;
  double reflectance_block = 0.0, transmittance_block = 0.0;
  double greatest = 0.0;  ///< R + T of the polarization that has most
};

/// All nodes of incidence, lambda slowest, then psi, then sigma. `pass_index`: see pass_axis.h.
std::vector<IncidenceEnergy> incidence_energies(const BsdfTable& table, double pass_index);

}  // namespace evenglow::tracer
