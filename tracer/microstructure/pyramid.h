#pragma once

#include <cmath>

#include "core/config/config_node.h"
#include "tracer/microstructure/flat_facets.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/square_cell.h"

namespace evenglow::tracer {

/// Straight pyramid over the square |x|, |y| <= 1, pointed or with a flat top.
class SquarePyramid {
 public:
  /// `flank` (rad) between flank and face, in (0, pi/2); `truncation` = half the width of the flat top, in [0, 1);
  /// `fill` of the square cell by the footprint, in (0, 1].
  SquarePyramid(double flank, double truncation, double fill = 1.0);

  double height() const { return height_; }
  RaySpan span(const core::Vec3& p, const core::Vec3& k) const { return facets_.span(p, k); }
  core::Vec3 normal(int face, const core::Vec3&) const { return facets_.normal(face); }

  core::Vec3 point(core::PhotonRng& rng) const { return cell_.point(rng); }
  static bool covers(const core::Vec3& p) { return std::abs(p.x()) <= 1.0 && std::abs(p.y()) <= 1.0; }
  bool clears(const core::Vec3& p, const core::Vec3&) const { return p.z() >= height_; }
  double way_to_wall(const core::Vec3& p, const core::Vec3& k) const { return cell_.way_to_wall(p, k); }
  void next_cell(core::Vec3& p, const core::Vec3& k) const { cell_.next_cell(p, k); }

 private:
  SquareCell cell_;
  double height_;
  FlatFacets<5> facets_;
};

/// Pyramid or truncated pyramid with a square base, raised from the face or sunk into it, traced exactly
/// (`TracedBump`).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | form | raised, sunk | raised |
/// | flank_deg | angle between flank and face, 0.1 to 85 | 45 |
/// | aspect | height over width of the base, instead of flank_deg | |
/// | truncation | width of the flat top over that of the base, 0 to 0.95 | 0 |
/// | axis_deg | direction of a side of the base, from +x towards +y | 0 |
/// | fill | of the patterned area by footprints, 0.01 to 1 (`TracedBump`) | 1 |
Microstructure make_pyramid(const core::ConfigNode& node);

}  // namespace evenglow::tracer
