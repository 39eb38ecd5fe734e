#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/math/vec3.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/microstructure/square_cell.h"

namespace evenglow::tracer {

/// The cell of a bump over a round footprint of radius 1. Filled, it is the footprint itself, left and entered again at
/// the ends of one chord; else a square of a periodic pattern.
class RoundCell {
 public:
  /// `fill` of the cell by the footprint: 1, or in (0, pi/4].
  explicit RoundCell(double fill) : filled_(fill >= 1.0), square_{std::sqrt(0.25 * core::kPi / fill)} {}

  /// The chord of the footprint that a ray passes over.
  struct Chord {
    double x, y;      ///< horizontal direction of travel
    double speed;     ///< horizontal way per way
    double along;     ///< from the middle of the chord to the ray's place
    double distance;  ///< of the chord from the axis
    double half;      ///< half its length

    Chord(const core::Vec3& p, const core::Vec3& k) {
      speed = std::max(std::hypot(k.x(), k.y()), 1e-300);
      x = k.x() / speed;
      y = k.y() / speed;
      along = p.x() * x + p.y() * y;
      distance = std::min(std::abs(p.x() * y - p.y() * x), 1.0);
      half = std::sqrt((1.0 - distance) * (1.0 + distance));
    }
  };

  core::Vec3 point(core::PhotonRng& rng) const {
    if (!filled_) return square_.point(rng);
    const double radius = std::sqrt(rng.uniform());
    const double azimuth = 2.0 * core::kPi * rng.uniform();
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), 0.0};
  }
  bool covers(const core::Vec3& p) const { return filled_ || p.x() * p.x() + p.y() * p.y() < 1.0; }

  double way_to_wall(const core::Vec3& p, const core::Vec3& k) const {
    if (!filled_) return square_.way_to_wall(p, k);
    const Chord chord(p, k);
    return std::max(0.0, chord.half - chord.along) / chord.speed;
  }

  /// `Body::top(d)`: greatest height over a chord at the distance d from the axis.
  template <typename Body>
  bool clears(const core::Vec3& p, const core::Vec3& k, const Body& body) const {
    return p.z() >= (filled_ ? body.top(Chord(p, k).distance) : body.height());
  }

  /// On a chord, light that comes down from above the bump's top passes over as many bumps as it needs to.
  template <typename Body>
  void next_cell(core::Vec3& p, const core::Vec3& k, const Body& body) const {
    if (!filled_) return square_.next_cell(p, k);
    const Chord chord(p, k);
    const double steepness = k.z() / chord.speed;
    const double back = chord.along + chord.half;
    p.x() -= back * chord.x;
    p.y() -= back * chord.y;
    p.z() += (chord.half - chord.along) * steepness;
    const double drop = -2.0 * chord.half * steepness;
    const double top = body.top(chord.distance);
    if (drop > 0.0 && p.z() > top) p.z() -= drop * std::floor((p.z() - top) / drop);
    if (drop == 0.0 && steepness < 0.0) p.z() = 0.0;  // down over the rim itself
  }

 private:
  bool filled_;
  SquareCell square_;
};

}  // namespace evenglow::tracer
