#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/polarized_bsdf/alias_tables.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/incidence_grid.h"

namespace evenglow::tracer {

/// A `BsdfTable` made ready for analog Monte Carlo: at each node of incidence (`IncidenceGrid`) the table is resampled
/// on a grid in (u, phi') (outgoing_polar.h) for reflection and transmission, cut at the horizon and normalized. The
/// BSDF in use is by definition the weighted sum over the four nodes around an incidence of the bilinear interpolants
/// of S and of D (cos 2 delta, sin 2 delta) on these grids, so that `draw`, `response` and `integral` agree to rounding
/// (the grid lines' integrals of 2 u^3 are exact, those of r^2 to 1e-12).
///
/// Normalization. With a `HemisphericalTable` tau_min and tau_max of each node and kind are multiplied by one factor
/// each, so that the integrals for light along the pass and the block axis equal its values. Without one the table's
/// own integrals stay, scaled down where some polarization would get R + T > 1; `remarks()` tells what was done.
///
/// Linear polarization here is q = (q1, q2) = (Q, U) / I counted from the film's pass axis (the tangential count of
/// configs/data/README.md turned by psi). Power towards a direction, per unit incident: (S - D (cos 2 delta, sin 2
/// delta) . q) / 2.
class SampledBsdf {
 public:
  /// `pass_index`: refractive index that the pass axis of an oblique ray is counted with (pass_axis.h).
  SampledBsdf(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical, double pass_index);

  /// S (1/sr) and D (cos 2 delta, sin 2 delta) (1/sr), here times r^2 of the node; divided by r^2 of the ray it is the
  /// BSDF.
  struct Response {
    double S = 0.0, x = 0.0, y = 0.0;
    double kappa = 1.0;
    double power(double q1, double q2) const { return 0.5 * (S - x * q1 - y * q2); }
  };
  Response response(std::size_t node, ScatterKind kind, double u, double phi, double cos_phi, double sin_phi) const;

  /// Integral of the response over the hemisphere, dimensionless; of one kind, or of both.
  const Response& integral(std::size_t node, ScatterKind kind) const {
    return integrals_[node][static_cast<std::size_t>(kind)];
  }
  const Response& integral(std::size_t node) const { return totals_[node]; }

  /// A direction with density power(q) 2 u^3 / integral(node).power(q) in (u, phi') and kind. The integral must be > 0.
  struct Draw {
    ScatterKind kind = ScatterKind::reflection;
    double u = 0.0, cos_phi = 1.0, sin_phi = 0.0;
    Response response;
  };
  Draw draw(std::size_t node, double q1, double q2, core::PhotonRng& rng) const;

  const IncidenceGrid& incidences() const { return grid_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  std::size_t bytes() const;  ///< memory of the tables

 private:
  static constexpr std::size_t kU = 32;    ///< intervals of u in [0, 1]
  static constexpr std::size_t kPhi = 40;  ///< intervals of phi' in a turn
  static constexpr std::size_t kRing = kU + 1;
  static constexpr std::size_t kPoints = kPhi * kRing;  ///< of one node and kind
  static constexpr std::size_t kCells = kPhi * kU;

  /// (x, y): D / S (cos 2 delta, sin 2 delta) in units of 1/32767, rounded towards zero so that D <= S.
  struct Point {
    float S;
    std::int16_t x, y;
  };

  const Point* points(std::size_t node, std::size_t kind) const { return points_.data() + (node * 2 + kind) * kPoints; }
  Response bilinear(std::size_t node, std::size_t kind, std::size_t iu, std::size_t iphi, double tu, double tphi) const;
  void find_widest();
  void add_cell_bounds(std::size_t node, std::vector<double>& bounds);

  IncidenceGrid grid_;
  std::vector<Point> points_;  ///< node, kind, phi', u (u fastest)
  std::vector<float> kappas_;  ///< as points_; empty: 1 everywhere
  AliasTables cells_;          ///< of each node over kind, phi', u
  std::vector<std::array<Response, 2>> integrals_;
  std::vector<Response> totals_;
  std::array<double, kPhi + 1> cos_phi_{}, sin_phi_{};  ///< of the grid lines
  std::vector<std::array<double, kPhi>> widest_;        ///< largest r^2 in each interval of phi', by sigma node
  std::vector<std::string> remarks_;
};

}  // namespace evenglow::tracer
