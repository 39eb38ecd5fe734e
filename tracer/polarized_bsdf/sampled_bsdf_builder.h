#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/held_totals.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"

namespace evenglow::tracer {

/// Intervals of the outgoing grid: u in [0, 1], phi' in a turn.
struct ResamplingShape {
  std::size_t u = 0;
  std::size_t phi = 0;
};

/// Value of the table at a point of the outgoing grid, as `BsdfTable::Value` but with a signed share: light along the
/// pass axis may be the stronger one where a scale factor has turned them.
using ResampledPoint = BsdfTable::Value;

/// One incidence on the outgoing grid; points: phi' slow, u fast (shape.u + 1 of them).
struct ResampledNode {
  std::array<std::vector<ResampledPoint>, 2> kinds;  ///< by ScatterKind
  std::vector<double> weights;  ///< integral of the bilinear interpolant times 2 u^3 r^2 du dphi' = sum weight x value
};

/// Resamples and normalizes a table, incidence by incidence (see `SampledBsdf`).
class Resampler {
 public:
  Resampler(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical, double pass_index,
            const ResamplingShape& shape);

  ResampledNode node(double psi, double sigma);

  bool has_kappa() const { return has_kappa_; }
  /// What was done to the table so far, one sentence each.
  std::vector<std::string> remarks() const;

 private:
  std::vector<ResampledPoint> resampled(ScatterKind kind, double psi, double sigma);
  void unbias(std::vector<ResampledPoint>& points) const;
  template <typename Value>
  void note_error(const std::vector<ResampledPoint>& points, const Value& value);
  void normalize(std::vector<ResampledPoint>& points, const std::vector<double>& weights, double psi, double sigma,
                 double pass, double block);
  /// Beyond the table's last sigma, without a hemispherical table: scales each kind to the power for natural light that
  /// it has at that sigma, of which the horizon would cut off more and more.
  void hold_totals(ResampledNode& node, double psi, double sigma);
  void limit(ResampledNode& node);

  const BsdfTable& table_;
  double wavelength_nm_;
  const HemisphericalTable* hemispherical_;
  double pass_index_;
  ResamplingShape shape_;
  bool has_kappa_ = false;
  HeldTotals held_;
  double least_factor_ = 1.0, largest_factor_ = 1.0;  ///< of the normalization up to sigma = 60 degrees
  double least_limit_ = 1.0;                          ///< of the scaling down
  double error_ = 0.0, error_weight_ = 0.0;           ///< of the resampling, psi = 0
  std::size_t limited_ = 0, fallbacks_ = 0, nodes_ = 0;
};

}  // namespace evenglow::tracer
