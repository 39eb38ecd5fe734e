#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_cells.h"
#include "tracer/transport/planar_face.h"
#include "tracer/transport/planar_pattern.h"
#include "tracer/transport/planar_stack_walk.h"
#include "tracer/transport/planar_wall.h"

namespace evenglow::tracer {

/// The part of a walk that is spent in the plate, from face to face, and in the layers of air around it: total
/// reflections between two walls, or two meetings with the pattern, are taken in one step.
template <typename Light, typename Observer, typename Cells = PlanarCells>
class PlanarPlateWalk {
 public:
  using Walk = PhotonHistory::Walk;

  PlanarPlateWalk(const PlanarPlate& plate, const PlanarLayers& layers, const Cells& cells,
                  const PhotonHistory& history, const Scene& scene, Observer& observer)
      : plate_(plate),
        history_(history),
        scene_(scene),
        s_(plate),
        pattern_(s_, cells, history, scene, observer),
        stack_(s_, layers, history, scene) {
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
      if (!gets_in(side, walk, rng)) return follow_around(side, walk, progress, rng, sums);
    } else {
      if (!plate_.smooth[static_cast<std::size_t>(side)]) {
        const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit.quad)];
        return meet_as_surface(walk, hit, {surface.optics, surface.part}, progress, rng, sums);
      }
      walk.coverage = {};
      walk.corner = -1;
      if (enter_wall(side, walk.photon, rng) == WallEnd::kOutside) return true;
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
  using StackEnd = typename PlanarStackWalk<Light>::End;
  enum class Leg { kReflected, kLeft, kOut, kAbsorbed, kMet, kAtXWall, kAtYWall };
  enum class Around { kInside, kElsewhere, kEnded };

  /// All that a leg is made of stands in this one function: calls would cost a tenth of the time.
  [[gnu::noinline]] bool follow(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    while (progress.events < PhotonHistory::kMaxEvents) {
      Leg end = leg(walk, progress, rng, sums);
      // Walls x = const and y = const by code of their own: what is then done to x and y needs no choice.
      if (end == Leg::kAtXWall) {
        end = at_wall<true>(walk, progress, rng);
      } else if (end == Leg::kAtYWall) {
        end = at_wall<false>(walk, progress, rng);
      }
      switch (end) {
        case Leg::kReflected:
        case Leg::kAtXWall:
        case Leg::kAtYWall:
          break;
        case Leg::kLeft:
          return true;
        case Leg::kOut:
          switch (around(out_side_, walk, progress, rng, sums)) {
            case Around::kInside:
              break;
            case Around::kElsewhere:
              return true;
            case Around::kEnded:
              return false;
          }
          break;
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

  WallEnd enter_wall(int side, Photon& photon, core::PhotonRng& rng) {
    return side < 2 ? PlanarWall<Light, true>(s_, side).from_outside(photon, rng)
                    : PlanarWall<Light, false>(s_, side).from_outside(photon, rng);
  }

  [[gnu::noinline]] bool follow_around(int side, Walk& walk, PlanarProgress& progress, core::PhotonRng& rng,
                                       BatchSums& sums) {
    const Around end = around(side, walk, progress, rng, sums);
    return end == Around::kInside ? follow(walk, progress, rng, sums) : end == Around::kElsewhere;
  }

  /// Light in air at a face of the plate, through the layers until it is in the plate.
  [[gnu::noinline]] Around around(int side, Walk& walk, PlanarProgress& progress, core::PhotonRng& rng,
                                  BatchSums& sums) {
    while (true) {
      const auto end = stack_.run(side, walk, progress, rng, sums);
      if (end == StackEnd::kEnded) return Around::kEnded;
      if (end == StackEnd::kElsewhere) return Around::kElsewhere;
      side = stack_.side();
      if (side == plate_.pattern_side && pattern_.meets(progress, rng)) {
        const int quad = plate_.quads[static_cast<std::size_t>(side)];
        s_.leave(walk.photon, quad, s_.light.stokes());
        const RayHit hit{quad, stack_.distance(), s_.position()};
        if (!history_.interact(walk, hit, {plate_.pattern, plate_.pattern_part}, rng, sums)) return Around::kEnded;
        if (walk.photon.body == plate_.body) {
          s_.load(walk.photon);
          return Around::kInside;
        }
        if constexpr (Cells::kMovesLight) {
          s_.x = walk.photon.position.x();
          s_.y = walk.photon.position.y();
        }
        s_.light = Light(walk.photon.light);
      } else if (gets_in(side, walk, rng)) {
        walk.photon.body = plate_.body;
        return Around::kInside;
      }
    }
  }

  /// Light in air at the smooth bottom or top.
  bool gets_in(int side, Walk& walk, core::PhotonRng& rng) {
    pass_levels(walk, side == static_cast<int>(Side::kTop) ? 1 : 0, 1);
    walk.corner = -1;
    return PlanarFace<Light>(s_, side).gets_in(rng);
  }

  /// From outside, by the surface's own optics.
  bool meet_as_surface(Walk& walk, const RayHit& hit, const PhotonHistory::Encounter& encounter,
                       PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    if (!history_.interact(walk, hit, encounter, rng, sums)) return false;
    return walk.photon.body == plate_.body ? run(walk, progress, rng, sums) : true;
  }

  /// What `NextEvent` would be told of meetings with smooth bottoms and tops in turn, `first` (0: bottom) the next one.
  [[gnu::always_inline]] void pass_levels(Walk& walk, std::size_t first, std::int64_t faces) const {
    if (!walk.coverage.covered || faces == 0) return;
    walk.coverage.straight = false;
    const int last = level_[faces % 2 != 0 ? first : 1 - first];
    const bool all_known = level_[first] >= 0 && last >= 0;
    walk.coverage.covered = all_known && std::abs(level_[first] - walk.coverage.level) == 1;
    walk.coverage.level = last;
  }

  [[gnu::always_inline]] Leg leg(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    const Light& k = s_.light;
    // Without branches: the signs are as random as the light.
    const auto ahead = [](double k_axis, double half, double from_center) {
      return half - std::copysign(1.0, k_axis) * from_center;
    };
    const double to_x = ahead(k.kx, plate_.half.x(), s_.x - plate_.center.x()) * s_.way_x;
    const double to_y = ahead(k.ky, plate_.half.y(), s_.y - plate_.center.y()) * s_.way_y;
    const double to_face = std::max(0.0, ahead(k.kz, plate_.half.z(), s_.z - plate_.center.z())) * s_.way_z;
    const double to_wall = std::max(0.0, std::min(to_x, to_y));
    if (s_.guided) return guided_leg(walk, progress, rng, sums, to_x < to_y, to_wall, to_face);
    const double distance = std::min(to_wall, to_face);
    ++progress.events;
    walk.optical_depth -= plate_.absorption * distance;
    if (walk.optical_depth <= 0.0) return absorbed_by(plate_.part);
    s_.x += k.kx * distance;
    s_.y += k.ky * distance;
    s_.z += k.kz * distance;
    if (to_wall < to_face) {
      hit_distance_ = distance;
      return to_x < to_y ? Leg::kAtXWall : Leg::kAtYWall;
    }
    return at_face(walk, progress, rng, sums, distance);
  }

  [[gnu::always_inline]] Leg absorbed_by(int part) {
    absorber_ = part;
    return Leg::kAbsorbed;
  }

  /// All total reflections up to a wall, a meeting with the pattern, or absorption.
  [[gnu::always_inline]] Leg guided_leg(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums,
                                        bool x_wall, double to_wall, double to_face) {
    const Box& box = plate_.box;
    Light& k = s_.light;
    double distance = to_wall;
    Leg end = Leg::kReflected;
    if (plate_.absorption * distance >= walk.optical_depth) {
      distance = walk.optical_depth / plate_.absorption;
      end = absorbed_by(plate_.part);
    }
    const double period = plate_.height * s_.way_z;
    // 1 + the whole number of heights beyond the first face; a way that ends before it is not as long as one height.
    const auto faces_on_way = std::max(0.0, (distance - to_face) * std::abs(k.kz) * plate_.per_height + 1.0);
    auto faces = static_cast<std::int64_t>(faces_on_way);
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
      // A plain dot forgets the polarization, if it is no mirror.
      if (end != Leg::kMet || !plate_.dots.known || plate_.dots.mirrored > 0.0) s_.reflect_totally(k, faces);
      from_last -= to_face + static_cast<double>(faces - 1) * period;
      k.kz *= static_cast<double>(1 - 2 * (faces % 2));
      s_.z = plate_.center.z() - std::copysign(plate_.half.z(), k.kz);
    }
    s_.z = std::clamp(s_.z + k.kz * from_last, box.min.z(), box.max.z());
    walk.optical_depth -= plate_.absorption * distance;
    if (end == Leg::kAbsorbed) return end;
    if (end == Leg::kMet) return meet_pattern(distance);
    hit_distance_ = distance;
    return x_wall ? Leg::kAtXWall : Leg::kAtYWall;
  }

  [[gnu::always_inline]] Leg meet_pattern(double distance) {
    s_.clamp_into_plate();
    s_.z = s_.plane(plate_.pattern_side);
    hit_quad_ = plate_.quads[static_cast<std::size_t>(plate_.pattern_side)];
    hit_distance_ = distance;
    encounter_ = {plate_.pattern, plate_.pattern_part};
    return Leg::kMet;
  }

  /// At the bottom or the top, where light gets out.
  [[gnu::always_inline]] Leg at_face(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums,
                                     double distance) {
    const bool upward = s_.light.kz > 0.0;
    const int side = static_cast<int>(upward ? Side::kTop : Side::kBottom);
    if (side == plate_.pattern_side && pattern_.meets_from_inside(walk, progress, rng, sums)) {
      return meet_pattern(distance);
    }
    pass_levels(walk, upward ? 1 : 0, 1);
    s_.z = s_.plane(side);
    if (!PlanarFace<Light>(s_, side).gets_out(rng)) return Leg::kReflected;
    out_side_ = side;
    return Leg::kOut;
  }

  template <bool kXWall>
  [[gnu::always_inline]] Leg at_wall(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng) {
    const double kn = kXWall ? s_.light.kx : s_.light.ky;
    const int side = (kXWall ? 0 : 2) + (std::signbit(kn) ? 0 : 1);
    (kXWall ? s_.x : s_.y) = s_.plane(side);
    if (!plate_.smooth[static_cast<std::size_t>(side)]) {
      s_.clamp_into_plate();
      hit_quad_ = plate_.quads[static_cast<std::size_t>(side)];
      const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit_quad_)];
      encounter_ = {surface.optics, surface.part};
      return Leg::kMet;
    }
    if (walk.coverage.covered)
      history_.next_event().meet_wall(walk.coverage, side, {s_.light.kx, s_.light.ky, s_.light.kz}, walk.band);
    walk.corner = -1;
    switch (PlanarWall<Light, kXWall>(s_, side).from_inside(walk.photon, progress, rng)) {
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
  PlanarPattern<Light, Observer, Cells> pattern_;
  PlanarStackWalk<Light> stack_;
  int out_side_ = 4;
  std::array<int, 2> level_{-1, -1};  ///< of bottom and top (`ViewerLevels`)
  int absorber_ = 0;
  int hit_quad_ = -1;
  double hit_distance_ = 0.0;
  PhotonHistory::Encounter encounter_;
};

}  // namespace evenglow::tracer
