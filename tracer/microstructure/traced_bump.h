#pragma once

#include <algorithm>
#include <optional>

#include "tracer/microstructure/bump_facet.h"
#include "tracer/microstructure/bump_placement.h"
#include "tracer/microstructure/dot_trace.h"
#include "tracer/microstructure/ray_span.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A small clear structure on the plate, traced exactly and polarized; raised (of the plate's material, in air) or sunk
/// (of air, in the plate). Geometric optics, no absorption inside, no interference.
///
/// The model. A photon meets the pattern with the odds of the local density, whatever its direction. So that share of
/// the face is taken as patches in which equal structures stand in a periodic pattern, a cell each, footprints covering
/// the share `fill` of it; the rest is bare face. Within a patch all is exact. Light comes to a point drawn uniformly
/// in a cell: in the plane of the footprint from the bump's own side, in that of the tops from the other. It is
/// followed through the bump, beside it and over the bare face of the cell, and what leaves the cell sideways goes on
/// in the next: so it may leave a flank and enter the same or another bump, any number of times, until it crosses the
/// plane of the footprints (down) or of the tops (up). With fill 1 there is no bare face in the cell; as round
/// footprints tile no plane, light then leaves one and enters the next at the two ends of its own chord, as if the
/// neighbor stood right in its way.
///
/// Every step keeps the volume of phase space and can be reversed. So etendue and reciprocity hold for the pair of bare
/// face and structure at any density: with radiance 1 outside and n^2 inside, what leaves has radiance 1 and n^2 in all
/// directions. A lone bump cannot keep this promise with odds that are the same for all directions: along k its
/// silhouette covers more of the plane than its footprint, at grazing incidence without limit, so it would send out
/// more than its share of the plane receives. What neighbors shade must therefore be in the model.
///
/// Limits. Shading is that of the patch, not of the local density: choose `fill` near the coverage of the real pattern
/// where the structures are steep (docs/microstructures.md has figures). Neighbors outside the patch are not there. The
/// way from entrance to exit, micrometers, is neglected on the plate. Where the real places of the structures are given
/// (`DotShape`), each is met where it stands instead and these limits fall away.
///
/// `Shape`, a convex body over its footprint in z = 0 with its cell, in units of half the footprint's width:
/// - `double height()`;
/// - `RaySpan span(p, k)` of a line in the body, faces by numbers, `RaySpan::kFootprint` for the footprint;
/// - `Vec3 normal(face, p)`: outward;
/// - `Vec3 point(PhotonRng&)`: uniform in the cell, z = 0; `bool covers(p)`: is it in the footprint?
/// - `bool clears(p, k)`: can light that rises beside the bump, at p, no longer meet this or another bump?
/// - `double way_to_wall(p, k)` of the cell; `void next_cell(p, k)` moves p there and into the next cell.
template <typename Shape>
class TracedBump final : public Bsdf, public DotShape {
 public:
  /// Meetings of one photon and cells between two of them; what needs more counts as absorbed. No ray of
  /// positive measure is caught for ever, as a path of light can be reversed.
  static constexpr int kMaxMeetings = 1000;
  static constexpr int kMaxCells = 20000;

  TracedBump(Shape shape, const BumpPlacement& placement, double plate_index)
      : shape_(std::move(shape)),
        placement_(placement),
        face_(placement.sunk() ? DielectricFace(1.0, plate_index) : DielectricFace(plate_index, 1.0)),
        ratio_(placement.sunk() ? 1.0 / plate_index : plate_index) {}

  std::optional<BsdfSample> sample(const core::StokesVector& incident, core::PhotonRng& rng) const override {
    core::StokesVector light = placement_.into_bump(incident);
    core::Vec3 p = shape_.point(rng);
    bool inside = light.frame.k.z() > 0.0;
    if (!inside) p.z() = shape_.height();
    int met = inside && !shape_.covers(p) ? kBareFace : kNone;
    for (int meetings = 0; meetings < kMaxMeetings; ++meetings) {
      if (met != kBareFace) met = inside ? follow_inside(p, light.frame.k) : follow_outside(p, light.frame.k);
      if (met == RaySpan::kFootprint || met == kCleared) return left(light);
      if (met == kLost) return std::nullopt;
      const core::Vec3 normal = met == kBareFace ? core::Vec3(core::Vec3::UnitZ()) : shape_.normal(met, p);
      const FacetMeeting meeting = meet_facet(face_, normal, light, inside, rng);
      light = meeting.light;
      if (meeting.passed) inside = !inside;
      if (met == kBareFace && inside) return left(light);
      met = kNone;
    }
    return std::nullopt;
  }

  core::StokesVector evaluate(const core::StokesVector&, const core::Vec3& k_out) const override {
    return core::StokesVector::unpolarized(0.0, core::PolarizationFrame::any(k_out));
  }
  bool scatters() const override { return false; }
  bool redirects() const override { return true; }
  Specular specular(const core::Vec3&) const override { return {}; }

  bool meets_dot(const DotGrid& dots, const core::Vec2& place, const core::Vec3& k) const override {
    const double flip = placement_.growth();
    return trace(dots).meets({place.x(), flip * place.y()}, grown(k));
  }
  std::optional<Outcome> sample_among(const DotGrid& dots, const core::Vec2& place, const core::StokesVector& light,
                                      core::PhotonRng& rng) const override {
    const double flip = placement_.growth();
    auto outcome = trace(dots).sample({place.x(), flip * place.y()}, grown(light), rng);
    if (!outcome) return std::nullopt;
    return Outcome{grown(outcome->light), {outcome->place.x(), flip * outcome->place.y()}};
  }

 private:
  DotTrace<Shape> trace(const DotGrid& dots) const { return {shape_, dots, placement_.growth(), face_, ratio_}; }
  /// Between the axes of the backlight and those in which the bumps grow along z: half a turn about x, or none.
  core::Vec3 grown(const core::Vec3& v) const {
    const double flip = placement_.growth();
    return {v.x(), flip * v.y(), flip * v.z()};
  }
  core::StokesVector grown(const core::StokesVector& s) const {
    return {s.I, s.Q, s.U, s.V, {grown(s.frame.k), grown(s.frame.e1)}};
  }
  /// Besides the faces of the shape, which count from 0.
  enum Meeting { kNone = -1, kBareFace = -2, kCleared = -3, kLost = -4 };

  /// On to the face where a ray in the bump meets its surface.
  int follow_inside(core::Vec3& p, const core::Vec3& k) const {
    const RaySpan span = shape_.span(p, k);
    if (span.leave_face < 0) return kLost;  // along the horizon in an endless groove
    p += std::max(0.0, span.leave) * k;
    return span.leave_face;
  }

  /// On to where a ray beside the bump meets a bump or the bare face.
  int follow_outside(core::Vec3& p, const core::Vec3& k) const {
    // A ray that comes in over the rim of the footprint may enter at once, by rounding a little behind its place.
    constexpr double kTouch = 1e-12;
    for (int cell = 0; cell < kMaxCells; ++cell) {
      const RaySpan span = shape_.span(p, k);
      if (span.enter < span.leave && span.enter > -kTouch && span.enter_face != RaySpan::kFootprint) {
        p += std::max(0.0, span.enter) * k;
        return span.enter_face;
      }
      if (k.z() > 0.0) {
        if (shape_.clears(p, k)) return kCleared;
      } else if (p.z() <= -k.z() * shape_.way_to_wall(p, k)) {
        // Where there is no bare face, rounding has let it through between two rims.
        if (k.z() < 0.0) p -= p.z() / k.z() * k;
        p.z() = 0.0;
        return kBareFace;
      }
      shape_.next_cell(p, k);
    }
    return kLost;
  }

  std::optional<BsdfSample> left(core::StokesVector& light) const {
    // As many meetings as it may have had, the frame is one to rounding.
    light.frame.k.normalize();
    light.frame.e1 = (light.frame.e1 - light.frame.e1.dot(light.frame.k) * light.frame.k).normalized();
    return BsdfSample{placement_.out_of_bump(light), true};
  }

  Shape shape_;
  BumpPlacement placement_;
  DielectricFace face_;
  double ratio_;  ///< index of the bump's material over that around it
};

}  // namespace evenglow::tracer
