#pragma once

#include <cstdint>
#include <string>

#include "core/math/cell_field.h"
#include "core/math/vec3.h"
#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// How the luminance is estimated. `kCounting`: every photon that leaves within the cone. `kNextEvent`: at each scatter
/// in the topmost scattering film, the expected share that leaves in a direction drawn from the cone; photons that pass
/// that film straight are counted, so that the sum is unbiased.
enum class LuminanceEstimator { kCounting, kNextEvent };

/// A direction of view drawn from the cone, and the factor that makes up for how it is drawn.
struct View {
  core::Vec3 k;
  double weight = 1.0;
};

/// Luminance of each cell of the display's active area, averaged over a viewing cone about the display's normal or
/// about a tilted axis: L = flux into the cone / (area projected solid angle). The vector integral of the directions of
/// a cone about the unit vector a is pi sin^2(cone) a, so that its projected solid angle is pi sin^2(cone) a_z,
/// exactly, for any cone above the horizon. Scores are in 1/sr per photon.
class LuminanceReceiver final : public Receiver {
 public:
  /// `cells`: the active area at the top of the backlight (mm); `cone`: half angle (rad), in (0, pi/2]; `polar` (from
  /// the normal) and `azimuth` (from +x towards +y) of its axis (rad), polar + cone <= pi/2. Error otherwise.
  LuminanceReceiver(const core::CellGrid& cells, double cone, double polar = 0.0, double azimuth = 0.0);

  std::size_t bins() const override { return cells_.size(); }
  std::optional<Score> score(const Crossing& crossing) const override;

  const core::CellGrid& cells() const { return cells_; }
  /// For two uniform numbers in (0, 1): the mean of `weight` x (what goes to k, 1/sr) is the luminance of the cone.
  View sample_view(double u1, double u2) const;

 private:
  bool sees(const core::Vec3& k) const;

  core::CellGrid cells_;
  double sin_cone_;
  double cos_cone_;
  bool tilted_;
  core::Vec3 side_, up_, axis_;  // right-handed; `axis_` is that of the cone
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
