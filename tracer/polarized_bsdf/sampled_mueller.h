#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/montecarlo/photon_rng.h"
#include "tracer/polarized_bsdf/alias_tables.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/incidence_grid.h"
#include "tracer/polarized_bsdf/mueller_table.h"

namespace evenglow::tracer {

/// A `MuellerTable` made ready for analog Monte Carlo, as `SampledBsdf` does it with a `BsdfTable`: at each node of
/// incidence the matrices (film frames, see `MuellerTable`) are resampled on a grid in (u, phi') for reflection and
/// transmission and cut at the horizon. The BSDF in use is by definition the weighted sum over the four nodes around an
/// incidence of the bilinear interpolants of M on these grids: a mean of physical matrices with weights >= 0, so
/// physical.
///
/// Normalization. With a `HemisphericalTable` the matrices of each node and kind are multiplied from the right by one
/// diattenuator along the axis of the integral's own diattenuation, such that the integrals for light along the pass
/// and the block axis that the incident ray sees (pass_axis.h) equal its values; a product of physical matrices is
/// physical. Then, and without such a table, where some polarization (the largest over the Poincare sphere, T00 +
/// |(T01, T02, T03)| for the integral T) would get R + T > 1 all matrices of the node are scaled down. `remarks()`
/// tells what was done.
///
/// Stokes vectors here are in the film frame of the incident ray, of unit power.
class SampledMueller {
 public:
  SampledMueller(const MuellerTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                 double pass_index);

  /// M times r^2 of the node (divided by r^2 of the ray it is the BSDF, 1/sr); phi in [0, 2 pi].
  core::MuellerMatrix response(std::size_t node, ScatterKind kind, double u, double phi) const;

  /// First row of the integral of the response over the hemisphere; of one kind, or of both.
  const Eigen::Vector4d& integral(std::size_t node, ScatterKind kind) const {
    return integrals_[node][static_cast<std::size_t>(kind)];
  }
  Eigen::Vector4d integral(std::size_t node) const { return integrals_[node][0] + integrals_[node][1]; }

  /// A direction with density (first row of the response . s) 2 u^3 / (integral(node) . s) in (u, phi') and kind; the
  /// denominator must be > 0. By rejection from a bound m00 (1 + degree of polarization) for each cell.
  struct Draw {
    ScatterKind kind = ScatterKind::reflection;
    double u = 0.0, cos_phi = 1.0, sin_phi = 0.0;
  };
  Draw draw(std::size_t node, const Eigen::Vector4d& s, core::PhotonRng& rng) const;

  const IncidenceGrid& incidences() const { return grid_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  std::size_t bytes() const;  ///< memory of the tables

 private:
  static constexpr std::size_t kU = 32;    ///< intervals of u in [0, 1]
  static constexpr std::size_t kPhi = 40;  ///< intervals of phi' in a turn
  static constexpr std::size_t kRing = kU + 1;
  static constexpr std::size_t kPoints = kPhi * kRing;  ///< of one node and kind
  static constexpr std::size_t kCells = kPhi * kU;

  const Eigen::Matrix4f* points(std::size_t node, std::size_t kind) const {
    return points_.data() + (node * 2 + kind) * kPoints;
  }
  double peak(std::size_t node, std::size_t kind, std::size_t iphi, std::size_t iu) const;
  void add_cells(std::size_t node);
  void find_widest();

  IncidenceGrid grid_;
  std::vector<Eigen::Matrix4f> points_;  ///< node, kind, phi', u (u fastest)
  AliasTables cells_;                    ///< of each node over kind, phi', u
  std::vector<std::array<Eigen::Vector4d, 2>> integrals_;
  std::vector<std::array<double, kPhi>> widest_;  ///< largest r^2 in each interval of phi', by sigma node
  std::vector<std::string> remarks_;
};

}  // namespace evenglow::tracer
