#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_face.h"
#include "tracer/transport/planar_pattern.h"
#include "tracer/transport/planar_wall.h"

namespace evenglow::tracer {

/// The part of a walk that is spent in the plate, from face to face: total reflections between two walls, or two
/// meetings with the pattern, are taken in one step.
template <typename Light, typename Observer>
class PlanarPlateWalk {
 public:
  using Walk = PhotonHistory::Walk;

  PlanarPlateWalk(const PlanarPlate& plate, const PlanarCells& cells, const PhotonHistory& history, const Scene& scene,
                  Observer& observer)
      : plate_(plate), history_(history), scene_(scene), s_(plate), pattern_(s_, cells, history, scene, observer) {
    const ViewerLevels& levels = history.next_event().levels();
    level_[0] = levels.of_quad(plate.quads[static_cast<std::size_t>(Side::kBottom)]);
    level_[1] = levels.of_quad(plate.quads[static_cast<std::size_t>(Side::kTop)]);
  }

  /// A photon in air that has come to the face `side`: enters it and is followed until it is in air again (true) or
  /// ends (false).
  bool enter(Walk& walk, const RayHit& hit, int side, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    s_.x = hit.position.x();
    s_.y = hit.position.y();
    s_.z = hit.position.z();
    if (side >= 4) {
      s_.light = Light(walk.photon.light);
      if (side == plate_.pattern_side && pattern_.meets(progress, rng)) {
        return meet_as_surface(walk, hit, {plate_.pattern, plate_.pattern_part}, progress, rng, sums);
      }
      pass_levels(walk, side == static_cast<int>(Side::kTop) ? 1 : 0, 1);
      walk.corner = -1;
      if (!PlanarFace<Light>(s_, side).lets_in(walk.photon, rng)) return true;
    } else {
      if (!plate_.smooth[static_cast<std::size_t>(side)]) {
        const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit.quad)];
        return meet_as_surface(walk, hit, {surface.optics, surface.part}, progress, rng, sums);
      }
      walk.coverage = {};
      walk.corner = -1;
      if (PlanarWall<Light>(s_, side).from_outside(walk.photon, rng) == WallEnd::kOutside) return true;
    }
    walk.photon.body = plate_.body;
    return follow(walk, progress, rng, sums);
  }

  /// Follows a photon that is in the plate until it leaves it (true) or ends (false).
  bool run(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    s_.load(walk.photon);
    return follow(walk, progress, rng, sums);
  }

 private:
  enum class Leg { kReflected, kLeft, kEscaped, kAbsorbed, kMet };

  bool follow(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    while (progress.events < PhotonHistory::kMaxEvents) {
      switch (leg(walk, progress, rng, sums)) {
        case Leg::kReflected:
          break;
        case Leg::kLeft:
          return true;
        case Leg::kEscaped:
          ++progress.events;
          history_.escape(walk, sums);
          return false;
        case Leg::kAbsorbed:
          sums.energy[scene_.energy.absorbed_bin(absorber_)] += walk.weight.y();
          return false;
        case Leg::kMet:
          if (encounter_.optics == plate_.pattern && plate_.dots.known) {
            if (!pattern_.meet_dot(walk, rng, sums)) return false;
            break;
          }
          walk.photon.light = s_.light.stokes();
          if (!history_.interact(walk, {hit_quad_, hit_distance_, s_.position()}, encounter_, rng, sums)) return false;
          if (walk.photon.body != plate_.body) return true;
          s_.load(walk.photon);
          break;
      }
    }
    return true;
  }

  /// From outside, by the surface's own optics.
  bool meet_as_surface(Walk& walk, const RayHit& hit, const PhotonHistory::Encounter& encounter,
                       PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    if (!history_.interact(walk, hit, encounter, rng, sums)) return false;
    return walk.photon.body == plate_.body ? run(walk, progress, rng, sums) : true;
  }

  /// What `NextEvent` would be told of meetings with smooth bottoms and tops in turn, `first` (0: bottom) the next one.
  void pass_levels(Walk& walk, std::size_t first, std::int64_t faces) const {
    if (!walk.coverage.covered || faces == 0) return;
    walk.coverage.straight = false;
    const int last = level_[faces % 2 != 0 ? first : 1 - first];
    const bool all_known = level_[first] >= 0 && last >= 0;
    walk.coverage.covered = all_known && std::abs(level_[first] - walk.coverage.level) == 1;
    walk.coverage.level = last;
  }

  Leg leg(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    const Box& box = plate_.box;
    const Light& k = s_.light;
    const double to_x = (k.kx > 0.0 ? box.max.x() - s_.x : s_.x - box.min.x()) * s_.way_x;
    const double to_y = (k.ky > 0.0 ? box.max.y() - s_.y : s_.y - box.min.y()) * s_.way_y;
    const double to_face = std::max(0.0, k.kz > 0.0 ? box.max.z() - s_.z : s_.z - box.min.z()) * s_.way_z;
    const double to_wall = std::max(0.0, std::min(to_x, to_y));
    if (s_.face.total) return guided_leg(walk, progress, rng, sums, to_x < to_y, to_wall, to_face);
    const double distance = std::min(to_wall, to_face);
    ++progress.events;
    walk.optical_depth -= plate_.absorption * distance;
    if (walk.optical_depth <= 0.0) return absorbed_by(plate_.part);
    s_.x += k.kx * distance;
    s_.y += k.ky * distance;
    s_.z += k.kz * distance;
    if (to_wall < to_face) return at_wall(walk, progress, rng, to_x < to_y, distance);
    return at_face(walk, progress, rng, sums, distance);
  }

  Leg absorbed_by(int part) {
    absorber_ = part;
    return Leg::kAbsorbed;
  }

  /// All total reflections up to a wall, a meeting with the pattern, or absorption.
  Leg guided_leg(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums, bool x_wall,
                 double to_wall, double to_face) {
    const Box& box = plate_.box;
    Light& k = s_.light;
    double distance = to_wall;
    Leg end = Leg::kReflected;
    if (plate_.absorption * distance >= walk.optical_depth) {
      distance = walk.optical_depth / plate_.absorption;
      end = absorbed_by(plate_.part);
    }
    const double period = plate_.height * s_.way_z;
    std::int64_t faces = 0;
    if (to_face <= distance) {
      faces = 1 + static_cast<std::int64_t>((distance - to_face) * std::abs(k.kz) * plate_.per_height);
    }
    if (plate_.pattern_side >= 0) {
      const bool pattern_first = (k.kz > 0.0) == (plate_.pattern_side == static_cast<int>(Side::kTop));
      const std::int64_t before =
          pattern_.first_meeting(faces, pattern_first ? 0 : 1, to_face, period, walk, progress, rng, sums);
      if (before < faces) {
        faces = before;
        distance = to_face + static_cast<double>(before) * period;
        end = Leg::kMet;
      }
    }
    progress.events += faces + 1;
    pass_levels(walk, k.kz > 0.0 ? 1 : 0, faces);
    s_.x += k.kx * distance;
    s_.y += k.ky * distance;
    double from_last = distance;
    if (faces > 0) {
      k.reflect_totally(s_.face.phase_re, s_.face.phase_im, faces);
      from_last -= to_face + static_cast<double>(faces - 1) * period;
      if (faces % 2 != 0) k.kz = -k.kz;
      s_.z = k.kz > 0.0 ? box.min.z() : box.max.z();
    }
    s_.z = std::clamp(s_.z + k.kz * from_last, box.min.z(), box.max.z());
    walk.optical_depth -= plate_.absorption * distance;
    if (end == Leg::kAbsorbed) return end;
    if (end == Leg::kMet) return meet_pattern(distance);
    return at_wall(walk, progress, rng, x_wall, distance);
  }

  Leg meet_pattern(double distance) {
    s_.clamp_into_plate();
    s_.z = s_.plane(plate_.pattern_side);
    hit_quad_ = plate_.quads[static_cast<std::size_t>(plate_.pattern_side)];
    hit_distance_ = distance;
    encounter_ = {plate_.pattern, plate_.pattern_part};
    return Leg::kMet;
  }

  /// At the bottom or the top, where light gets out.
  Leg at_face(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums, double distance) {
    const bool upward = s_.light.kz > 0.0;
    const int side = static_cast<int>(upward ? Side::kTop : Side::kBottom);
    if (side == plate_.pattern_side && pattern_.meets_from_inside(walk, progress, rng, sums)) {
      return meet_pattern(distance);
    }
    pass_levels(walk, upward ? 1 : 0, 1);
    s_.z = s_.plane(side);
    if (!PlanarFace<Light>(s_, side).lets_out(walk.photon, rng)) return Leg::kReflected;
    walk.corner = -1;
    return upward && plate_.open_above ? Leg::kEscaped : Leg::kLeft;
  }

  Leg at_wall(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, bool x_wall, double distance) {
    const double kn = x_wall ? s_.light.kx : s_.light.ky;
    const int side = (x_wall ? 0 : 2) + (kn > 0.0 ? 1 : 0);
    (x_wall ? s_.x : s_.y) = s_.plane(side);
    if (!plate_.smooth[static_cast<std::size_t>(side)]) {
      s_.clamp_into_plate();
      hit_quad_ = plate_.quads[static_cast<std::size_t>(side)];
      hit_distance_ = distance;
      const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit_quad_)];
      encounter_ = {surface.optics, surface.part};
      return Leg::kMet;
    }
    if (walk.coverage.covered)
      history_.next_event().meet_wall(walk.coverage, side, {s_.light.kx, s_.light.ky, s_.light.kz}, walk.band);
    walk.corner = -1;
    switch (PlanarWall<Light>(s_, side).from_inside(walk.photon, progress, rng)) {
      case WallEnd::kInside:
        return Leg::kReflected;
      case WallEnd::kOutside:
        return Leg::kLeft;
      case WallEnd::kAbsorbed:
        break;
    }
    return absorbed_by(plate_.backings[static_cast<std::size_t>(side)].reflector.part);
  }

  const PlanarPlate& plate_;
  const PhotonHistory& history_;
  const Scene& scene_;
  PlanarPlateState<Light> s_;
  PlanarPattern<Light, Observer> pattern_;
  std::array<int, 2> level_{-1, -1};  ///< of bottom and top (`ViewerLevels`)
  int absorber_ = 0;
  int hit_quad_ = -1;
  double hit_distance_ = 0.0;
  PhotonHistory::Encounter encounter_;
};

}  // namespace evenglow::tracer
