#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/incidence_grid.h"
#include "tracer/polarized_bsdf/lobe_proposals.h"
#include "tracer/polarized_bsdf/sampled_bsdf_builder.h"

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
/// Where the table is the same to the last stored digit at psi and phi' as at -psi and -phi', one node serves for both:
/// less memory, of which more stays in the caches.
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

  /// Tells the processor that `draw` at this node will follow.
  void prefetch(std::size_t node) const {
    const std::size_t held = held_[node].place;
    for (std::size_t lobe = 0; lobe < kLobes; ++lobe) proposals_.prefetch(kLobes * held + lobe);
    __builtin_prefetch(&axes_[kKinds * held]);
    __builtin_prefetch(&axes_[kKinds * held + 1]);
  }

  const IncidenceGrid& incidences() const { return grid_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  std::size_t bytes() const;  ///< memory of the tables

 private:
  static constexpr std::size_t kU = 32;    ///< intervals of u in [0, 1]
  static constexpr std::size_t kPhi = 40;  ///< intervals of phi' in a turn
  static constexpr std::size_t kRing = kU + 1;
  static constexpr std::size_t kPoints = kPhi * kRing;  ///< of one node and kind
  static constexpr std::size_t kKinds = 2;
  static constexpr std::size_t kLobes = 2 * kKinds;  ///< of a node: kind x (light along its axis, across it)
  static constexpr std::size_t kRows = LobeProposals::kRows;
  static constexpr std::size_t kBlock = kPhi / kRows;  ///< intervals of phi' and of u in a block
  static_assert(kRows * kBlock == kPhi && LobeProposals::kColumns * kBlock == kU);
  static constexpr double kInt16 = 1.0 / 32767.0;  ///< unit of `Point::y`
  static constexpr double kBelowOne = 1.0 - 0x1.0p-53;

  /// Roots of A = (S - X) / 2 and B = (S + X) / 2 in units of the node, X along the node's axis and Y across it, and
  /// Y / (2 sqrt(A B)) in units of 1/32767, rounded towards zero: no stored point can have D > S.
  struct Point {
    std::uint16_t root_a, root_b;
    std::int16_t y;
  };
  /// The values of a point, or of the interpolant: power = (1 + qe) / 2 A + (1 - qe) / 2 B - qc Y / 2.
  struct Lobes {
    double a = 0.0, b = 0.0, y = 0.0;
  };
  /// Of one node and kind.
  struct Axis {
    double x = 1.0, y = 0.0;            ///< unit vector among (q1, q2) along which the two lobes differ most
    double unit_a = 0.0, unit_b = 0.0;  ///< of root_a, root_b
    double square_a = 0.0, square_b = 0.0, product = 0.0;  ///< of A, of B and of Y
    double total_a = 0.0, total_b = 0.0;                   ///< of the proposals of the two lobes
  };

  /// Where the tables of a node are held, and whether as they are (1) or seen in the mirror phi' -> -phi' (-1).
  struct Held {
    std::size_t place = 0;
    double mirror = 1.0;
  };
  /// Of one node and kind.
  struct Packed {
    Axis axis;
    std::vector<Point> points;
  };

  static std::size_t index(std::size_t place, std::size_t kind) { return place * kKinds + kind; }
  void add_node(std::size_t node, const ResampledNode& resampled, bool with_kappa);
  static Packed packed(const std::vector<ResampledPoint>& points, const std::vector<double>& weights);
  bool mirrors(const std::array<Packed, kKinds>& kinds, const ResampledNode& node, std::size_t place) const;
  static void scale(Axis& axis, double factor);
  void add_integrals(std::size_t place, const std::vector<double>& weights);
  std::array<double, 2> bounds(std::size_t index, std::size_t row, std::size_t column) const;
  void add_proposals(std::size_t place);
  Lobes value(std::size_t index, std::size_t point) const;
  Lobes bilinear(std::size_t index, std::size_t iu, std::size_t iphi, double tu, double tphi) const;
  Response turned(const Lobes& lobes, std::size_t index) const;
  double kappa(std::size_t index, std::size_t iu, std::size_t iphi, double tu, double tphi) const;
  void find_distances();

  IncidenceGrid grid_;
  std::vector<Held> held_;                               ///< of each node
  std::vector<std::size_t> sigmas_;                      ///< of each place: sigma node
  std::vector<Point> points_;                            ///< place, kind, phi', u (u fastest)
  std::vector<float> kappas_;                            ///< as points_; empty: 1 everywhere
  std::vector<Axis> axes_;                               ///< place, kind
  LobeProposals proposals_;                              ///< place, kind, lobe
  std::vector<std::array<Response, kKinds>> integrals_;  ///< of each node
  std::vector<Response> totals_;
  std::array<double, kRows> cos_row_{}, sin_row_{};       ///< of the middles of the rows of blocks
  std::vector<std::vector<double>> squared_distances_;    ///< r^2 against phi', by sigma node
  std::array<double, LobeProposals::kColumns + 1> u4_{};  ///< fourth power of u / kU at the columns' borders
  std::vector<std::string> remarks_;
};

}  // namespace evenglow::tracer
