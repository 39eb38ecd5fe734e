#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/math/cell_field.h"
#include "core/math/vec3.h"
#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// How the luminance is estimated. `kCounting`: every photon that leaves within the cone. `kNextEvent`: at each
/// scatter, the expected share that goes to the viewer; photons whose way that leaves out are counted, so that the sum
/// is unbiased (docs/theory.md).
enum class LuminanceEstimator { kCounting, kNextEvent };

/// A direction of view drawn from the cone or towards the pupil, and the factor that makes up for how it is drawn.
struct View {
  core::Vec3 k;
  double weight = 1.0;
  std::size_t direction = 0;  ///< which of several directions of view it is of
};

/// A direction that the display is seen from, the axis of a cone, and its share of the luminance that counts.
struct ViewDirection {
  double polar = 0.0;    ///< from the normal, rad
  double azimuth = 0.0;  ///< from +x towards +y, rad
  double share = 1.0;    ///< of all directions; they sum to 1
};

/// The pupil of an eye or a camera before the display: a disk parallel to it, mm.
struct Pupil {
  core::Vec3 center = core::Vec3::Zero();
  double radius = 0.0;
  double display_z = 0.0;  ///< of the plane where light leaves the backlight; below the center

  bool sees(const core::Vec3& position, const core::Vec3& k) const;
  /// Of the disk from a point of a plane parallel to it, sr: pi times the view factor from an element to a parallel
  /// disk off its axis (Howell, Menguc, Daun, Siegel: Thermal Radiation Heat Transfer, configuration B-13).
  double projected_solid_angle(const core::Vec3& position) const;
};

/// Luminance of each cell of the display's active area, averaged over a viewing cone about the display's normal or
/// about a tilted axis: L = flux into the cone / (area projected solid angle). The vector integral of the directions of
/// a cone about the unit vector a is pi sin^2(cone) a, so that its projected solid angle is pi sin^2(cone) a_z,
/// exactly, for any cone above the horizon. Or seen through a pupil: the same with the flux into the pupil and its
/// projected solid angle from each place, so that the direction of view varies over the display. Scores are in 1/sr per
/// photon.
///
/// Several directions with cones of one half angle count with their shares: what counts is sum_v share_v L_v. Views are
/// drawn from direction v with the odds share_v, so that the scores of all directions together are this sum; each
/// direction has bins of its own (view_sums.h).
class LuminanceReceiver final : public Receiver {
 public:
  /// `cells`: the active area at the top of the backlight (mm); `cone`: half angle (rad), in [0, pi/2]; `polar` (from
  /// the normal) and `azimuth` (from +x towards +y) of its axis (rad), polar + cone <= pi/2. Error otherwise.
  LuminanceReceiver(const core::CellGrid& cells, double cone, double polar = 0.0, double azimuth = 0.0);
  /// The same with several directions; at least one, shares above 0 that sum to 1. Error otherwise.
  LuminanceReceiver(const core::CellGrid& cells, double cone, const std::vector<ViewDirection>& directions);
  /// Photons cannot be counted in one direction: below `kLeastCountedCone` those that leave without an estimate are
  /// counted in a cone of `kWideCountedCone` instead, whose luminance stands for that of the narrow one.
  static constexpr double kLeastCountedCone = 0.499 * core::kRadPerDeg;
  static constexpr double kWideCountedCone = 5.0 * core::kRadPerDeg;
  /// Error unless the pupil has a radius and lies above the display.
  LuminanceReceiver(const core::CellGrid& cells, const Pupil& pupil);

  /// Bin direction * cells + cell.
  std::size_t bins() const override { return directions() * cells_.size(); }
  std::size_t directions() const { return cones_.size(); }
  /// Of the first direction.
  std::optional<Score> score(const Crossing& crossing) const override { return score(crossing, 0); }
  /// Cones may overlap, so that a photon may count for several directions.
  std::optional<Score> score(const Crossing& crossing, std::size_t direction) const;

  const core::CellGrid& cells() const { return cells_; }
  /// For two uniform numbers in (0, 1): a direction of view from `position`, at or below the display's plane. The light
  /// that goes there (1/sr) is to be scored by `score_view` from where it leaves the backlight; the mean of such scores
  /// over the numbers is the luminance.
  /// `aside`: how far from `position` the light may leave, beyond what a sheet does (mm); for a cone it does not
  /// matter.
  View sample_view(const core::Vec3& position, double u1, double u2, double aside = 0.0) const;
  /// The pupil, if it is one that sees the light.
  const std::optional<Pupil>& pupil() const { return pupil_; }
  /// Bin and factor for a drawn view that leaves the backlight at `seen` (x and y count). Empty: outside the active
  /// area, or past the pupil (sheets above a scatterer shift its light, so `sample_view` draws from all directions that
  /// may come in).
  std::optional<Score> score_view(const core::Vec3& seen, const View& view) const;

 private:
  /// What lies about the axis of one direction.
  struct Cone {
    bool tilted;
    core::Vec3 side, up, axis;  ///< right-handed
    double weight;              ///< of a counted photon
    double share;
  };
  bool sees(const core::Vec3& k, const Cone& cone) const;
  View sample_cone(std::size_t direction, double u1, double u2) const;
  View sample_pupil(const core::Vec3& position, double u1, double u2, double aside) const;

  core::CellGrid cells_;
  double sin_cone_;
  double sin_counted_ = 0.0, cos_counted_ = 1.0;  ///< of the cone that photons are counted in
  std::vector<Cone> cones_;
  std::optional<Pupil> pupil_;
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
