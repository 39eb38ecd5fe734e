#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "tracer/polarized_bsdf/held_totals.h"
#include "tracer/polarized_bsdf/hemispherical_table.h"
#include "tracer/polarized_bsdf/mueller_table.h"

namespace evenglow::tracer {

/// One incidence on the outgoing grid; points: phi' slow, u fast.
struct ResampledMuellerNode {
  std::array<std::vector<core::MuellerMatrix>, 2> kinds;  ///< by ScatterKind
  std::vector<double> weights;                            ///< `outgoing_weights`
};

/// Resamples and normalizes a table of Mueller matrices, incidence by incidence (see `SampledMueller`).
class MuellerResampler {
 public:
  /// `u`, `phi`: intervals of the outgoing grid.
  MuellerResampler(const MuellerTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                   double pass_index, std::size_t u, std::size_t phi);

  ResampledMuellerNode node(double psi, double sigma);
  /// What was done to the table so far, one sentence each.
  std::vector<std::string> remarks() const;

 private:
  std::vector<core::MuellerMatrix> resampled(ScatterKind kind, double psi, double sigma) const;
  void normalize(std::vector<core::MuellerMatrix>& points, const std::vector<double>& weights, double psi, double sigma,
                 double pass, double block);
  /// As `Resampler` does it.
  void hold_totals(ResampledMuellerNode& node, double psi, double sigma);
  void limit(ResampledMuellerNode& node);

  const MuellerTable& table_;
  double wavelength_nm_;
  const HemisphericalTable* hemispherical_;
  double pass_index_;
  std::size_t u_, phi_;
  HeldTotals held_;
  double least_factor_ = 1.0, largest_factor_ = 1.0;  ///< of the normalization up to sigma = 60 degrees
  double least_limit_ = 1.0;                          ///< of the scaling down
  std::size_t limited_ = 0, fallbacks_ = 0, nodes_ = 0;
};

}  // namespace evenglow::tracer
