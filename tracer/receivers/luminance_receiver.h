#pragma once

#include <cstdint>
#include <string>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// How the luminance is estimated. `kCounting`: every photon that leaves within the cone. `kNextEvent`: at each scatter
/// in the topmost scattering film, the expected share that leaves in a direction drawn from the cone; photons that pass
/// that film straight are counted, so that the sum is unbiased.
enum class LuminanceEstimator { kCounting, kNextEvent };

/// Luminance of each cell of the display's active area, averaged over a viewing cone about the display's normal:
/// L = flux into the cone / (area pi sin^2 cone). Scores are in 1/sr per photon.
class LuminanceReceiver final : public Receiver {
 public:
  /// `cells`: the active area at the top of the backlight (mm); `cone`: half angle (rad), in (0, pi/2].
  LuminanceReceiver(const core::CellGrid& cells, double cone);

  std::size_t bins() const override { return cells_.size(); }
  std::optional<Score> score(const Crossing& crossing) const override;

  const core::CellGrid& cells() const { return cells_; }
  double sin_cone() const { return sin_cone_; }

 private:
  core::CellGrid cells_;
  double sin_cone_;
  double weight_;
};

/// Luminance of each cell with its standard error (cd/m2).
struct LuminanceMap {
  core::CellField luminance;
  core::CellField standard_error;
};

/// Turns scores (1/sr, summed over `photons` photons that share `flux` lm) into cd/m2.
LuminanceMap make_luminance_map(const LuminanceReceiver& receiver, const core::Tally& tally, double flux,
                                std::uint64_t photons);

/// cd/m2 for a score of 1/sr.
double luminance_per_score(const LuminanceReceiver& receiver, double flux, std::uint64_t photons);

}  // namespace evenglow::tracer
