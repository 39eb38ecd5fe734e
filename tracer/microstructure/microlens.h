#pragma once

#include "core/config/config_node.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/ray_span.h"
#include "tracer/microstructure/round_cell.h"

namespace evenglow::tracer {

/// Cap of a sphere over a round footprint of radius 1: of radius (1 + h^2) / (2 h), with its center below the
/// footprint.
class SphericalCap {
 public:
  /// `aspect` = height / diameter in (0, 0.5]; `fill` as `RoundCell`.
  explicit SphericalCap(double aspect, double fill = 1.0);

  double height() const { return height_; }
  RaySpan span(const core::Vec3& p, const core::Vec3& k) const;
  core::Vec3 normal(int face, const core::Vec3& p) const;
  /// Greatest height over a chord at this distance from the axis.
  double top(double distance) const;

  core::Vec3 point(core::PhotonRng& rng) const { return cell_.point(rng); }
  bool covers(const core::Vec3& p) const { return cell_.covers(p); }
  bool clears(const core::Vec3& p, const core::Vec3& k) const { return cell_.clears(p, k, *this); }
  double way_to_wall(const core::Vec3& p, const core::Vec3& k) const { return cell_.way_to_wall(p, k); }
  void next_cell(core::Vec3& p, const core::Vec3& k) const { cell_.next_cell(p, k, *this); }

 private:
  RoundCell cell_;
  double height_;
  double depth_;  ///< of the center below the footprint
};

/// Lens: a cap of a sphere, raised from the face or sunk into it, traced exactly (`TracedBump`).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | form | raised, sunk | raised |
/// | aspect | height over diameter, 0.0001 to 0.5 (half a sphere) | 0.2 |
/// | fill | of the patterned area by footprints: 1, or 0.01 to 0.785 (`TracedBump`) | 1 |
Microstructure make_microlens(const core::ConfigNode& node);

}  // namespace evenglow::tracer
