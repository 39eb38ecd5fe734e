#pragma once

#include <cmath>

#include "core/config/config_node.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/microstructure/flat_facets.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/square_cell.h"

namespace evenglow::tracer {

/// Prism over the strip |x| <= 1, straight along y, with a flank on each side.
class Ridge {
 public:
  /// Angles (rad) between flank and face, in (0, pi/2): the flank on the side of -x, of +x. `fill` of the period by the
  /// footprint, in (0, 1].
  Ridge(double left, double right, double fill = 1.0);

  double height() const { return height_; }
  RaySpan span(const core::Vec3& p, const core::Vec3& k) const { return facets_.span(p, k); }
  core::Vec3 normal(int face, const core::Vec3&) const { return facets_.normal(face); }

  /// The place along the ridge does not matter.
  core::Vec3 point(core::PhotonRng& rng) const { return {half_ * (2.0 * rng.uniform() - 1.0), 0.0, 0.0}; }
  static bool covers(const core::Vec3& p) { return std::abs(p.x()) <= 1.0; }
  bool clears(const core::Vec3& p, const core::Vec3&) const { return p.z() >= height_; }
  double way_to_wall(const core::Vec3& p, const core::Vec3& k) const { return way_to_walls(p.x(), k.x(), half_); }
  void next_cell(core::Vec3& p, const core::Vec3& k) const;

 private:
  double half_;  ///< of the period
  double height_;
  FlatFacets<2> facets_;
};

/// Groove with two straight flanks cut into the face (sunk), or a prism on it (raised), traced exactly (`TracedBump`);
/// its ends are neglected.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | form | raised, sunk | raised |
/// | flanks_deg | angles between flank and face, 0.1 to 85, of the two flanks: first that on the side of -c, then +c,
/// where c is the axis turned back by 90 degrees (+x for an axis along y) | [45, 45] | | axis_deg | direction of the
/// groove, from +x towards +y | 90 | | fill | of the patterned area by footprints, 0.01 to 1 (`TracedBump`) | 1 |
Microstructure make_v_groove(const core::ConfigNode& node);

}  // namespace evenglow::tracer
