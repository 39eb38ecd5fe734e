#pragma once

#include "core/config/config_node.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/ray_span.h"
#include "tracer/microstructure/round_cell.h"

namespace evenglow::tracer {

/// Straight cone over a round footprint of radius 1, pointed or with a flat top.
class ConicBump {
 public:
  /// `flank` (rad) between flank and face, in (0, pi/2); `truncation` = radius of the flat top, in [0, 1);
  /// `fill` as `RoundCell`.
  ConicBump(double flank, double truncation, double fill = 1.0);

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
  static constexpr int kFlank = 1;
  static constexpr int kTop = 2;
  void cut_flank(const core::Vec3& p, const core::Vec3& k, RaySpan& span) const;
  RoundCell cell_;
  double apex_;  ///< height of the tip, cut off or not: the tangent of the flank
  double height_;
  double sin_flank_, cos_flank_;
};

/// Cone or truncated cone, raised from the face or sunk into it, traced exactly (`TracedBump`).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | form | raised, sunk | raised |
/// | flank_deg | angle between flank and face, 0.1 to 85 | 45 |
/// | aspect | height over diameter, instead of flank_deg | |
/// | truncation | diameter of the flat top over that of the footprint, 0 to 0.95 | 0 |
/// | fill | of the patterned area by footprints: 1, or 0.01 to 0.785 (`TracedBump`) | 1 |
Microstructure make_cone(const core::ConfigNode& node);

}  // namespace evenglow::tracer
