#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_cells.h"
#include "tracer/transport/planar_wall.h"
#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {

/// A photon that comes to the patterned face, from inside or outside.
struct PatternArrival {
  std::size_t cell = 0;
  bool met = false;  ///< the microstructure, else the smooth face
  core::Vec3 position = core::Vec3::Zero();
  MeridianLight light{};
};

/// Is told nothing; costs nothing. Another observer has `kActive` = true and is called with each PatternArrival, or, if
/// it has `arrive(cell, met)`, with these two alone.
struct NoArrivalObserver {
  static constexpr bool kActive = false;
  void operator()(const PatternArrival&) const {}
};

/// The part of a walk that is spent in the plate, from face to face: total reflections between two walls, or two
/// meetings with the pattern, are taken in one step.
template <typename Light, typename Observer>
class PlanarPlateWalk {
 public:
  using Walk = PhotonHistory::Walk;

  PlanarPlateWalk(const PlanarPlate& plate, const PlanarCells& cells, const PhotonHistory& history, const Scene& scene,
                  Observer& observer)
      : plate_(plate), cells_(cells), history_(history), scene_(scene), observer_(observer), s_(plate) {
    const ViewerLevels& levels = history.next_event().levels();
    level_[0] = levels.of_quad(plate.quads[static_cast<std::size_t>(Side::kBottom)]);
    level_[1] = levels.of_quad(plate.quads[static_cast<std::size_t>(Side::kTop)]);
    estimates_ = history.next_event().active();
  }

  /// A photon in air that has come to the face `side`: enters it and is followed until it is in air again (true) or
  /// ends (false).
  bool enter(Walk& walk, const RayHit& hit, int side, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    s_.x = hit.position.x();
    s_.y = hit.position.y();
    s_.z = hit.position.z();
    if (side >= 4) {
      s_.light = Light(walk.photon.light);
      if (side == plate_.pattern_side && arrives_at_pattern(0, 0.0, progress, rng)) {
        return meet_as_surface(walk, hit, {plate_.pattern, plate_.pattern_part}, progress, rng, sums);
      }
      if (!passes_face_inwards(walk, side, rng)) return true;
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
            if (!meet_dot(walk, rng, sums)) return false;
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
          first_meeting(faces, pattern_first ? 0 : 1, to_face, period, walk, progress, rng, sums);
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

  /// Faces met before the pattern is: every second arrival from `first` on comes to the patterned face.
  std::int64_t first_meeting(std::int64_t faces, std::int64_t first, double to_face, double period, const Walk& walk,
                             PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    const double start = to_face + static_cast<double>(first) * period;
    double column = cells_.column(s_.x + s_.light.kx * start);
    double row = cells_.row(s_.y + s_.light.ky * start);
    const double columns = cells_.columns_per(2.0 * s_.light.kx * period);
    const double rows = cells_.rows_per(2.0 * s_.light.ky * period);
    for (std::int64_t face = first; face < faces; face += 2) {
      const std::size_t cell = cells_.cell(column, row);
      const bool met = progress.meets(cells_.open(cell), rng);
      if (estimates_ && progress.owes(NextEvent::estimates(cells_.depth(cell)))) {
        estimate_pattern(walk, face, to_face + static_cast<double>(face) * period, sums);
      }
      if constexpr (Observer::kActive) tell(cell, met, face, to_face + static_cast<double>(face) * period);
      if (met) return face;
      column += columns;
      row += rows;
    }
    return faces;
  }

  void tell(std::size_t cell, bool met, std::int64_t reflections, double distance) {
    if constexpr (requires(Observer & observer) { observer.arrive(cell, met); }) {
      observer_.arrive(cell, met);
    } else {
      tell_in_full(cell, met, reflections, distance);
    }
  }

  void tell_in_full(std::size_t cell, bool met, std::int64_t reflections, double distance) {
    Light light = s_.light;
    light.reflect_totally(s_.face.phase_re, s_.face.phase_im, reflections);
    if (reflections % 2 != 0) light.kz = -light.kz;
    const double z = s_.plane(plate_.pattern_side);
    observer_(PatternArrival{cell, met, {s_.x + light.kx * distance, s_.y + light.ky * distance, z}, light.meridian()});
  }

  bool arrives_at_pattern(std::int64_t reflections, double distance, PlanarProgress& progress, core::PhotonRng& rng) {
    const std::size_t cell = cells_.cell(cells_.column(s_.x), cells_.row(s_.y));
    const bool met = progress.meets(cells_.open(cell), rng);
    if constexpr (Observer::kActive) tell(cell, met, reflections, distance);
    return met;
  }

  Leg meet_pattern(double distance) {
    s_.clamp_into_plate();
    s_.z = s_.plane(plate_.pattern_side);
    hit_quad_ = plate_.quads[static_cast<std::size_t>(plate_.pattern_side)];
    hit_distance_ = distance;
    encounter_ = {plate_.pattern, plate_.pattern_part};
    return Leg::kMet;
  }

  /// A plain dot from inside; false: absorbed.
  bool meet_dot(Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
    const PlainReflector& dots = plate_.dots;
    const double u = rng.uniform();
    const bool mirrored = u < dots.mirrored;
    estimate_dot(walk, mirrored, sums);
    if (u >= dots.reflectance) {
      sums.energy[scene_.energy.absorbed_bin(dots.part)] += walk.weight.y();
      return false;
    }
    Light& k = s_.light;
    if (mirrored) {
      k.mirror();
      k.kz = -k.kz;
      return true;
    }
    const core::Vec3 out = lambertian(rng);
    k.forget_polarization();
    k.kx = out.x();
    k.ky = out.y();
    k.kz = std::copysign(out.z(), -k.kz);
    s_.turned();
    return true;
  }

  /// What `NextEvent` is due at an arrival at the pattern from inside, whether or not it is met.
  void estimate_pattern(const Walk& walk, std::int64_t reflections, double distance, BatchSums& sums) const {
    const int quad = plate_.quads[static_cast<std::size_t>(plate_.pattern_side)];
    const core::Vec3 place(s_.x + s_.light.kx * distance, s_.y + s_.light.ky * distance, s_.plane(plate_.pattern_side));
    core::StokesVector arriving{1.0, 0.0, 0.0, 0.0, {}};
    if (!plate_.dots.known) {  // else only the side counts from which it comes: along the normal, out of the plate
      Light light = s_.light;
      light.reflect_totally(s_.face.phase_re, s_.face.phase_im, reflections);
      if (reflections % 2 != 0) light.kz = -light.kz;
      arriving = to_local(scene_.optics[walk.band].surfaces[static_cast<std::size_t>(quad)], light.stokes());
    }
    history_.next_event().estimate_pattern({quad, *plate_.pattern, arriving, place, walk.band, walk.weight}, sums);
  }

  void estimate_dot(Walk& walk, bool mirrored, BatchSums& sums) const {
    const NextEvent& next_event = history_.next_event();
    if (!next_event.active()) return;
    const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit_quad_)];
    const core::StokesVector light = to_local(surface, s_.light.stokes());
    const core::Vec3 position = s_.position();
    const NextEvent::Meeting meeting{hit_quad_, *plate_.pattern, light, position, walk.band, walk.weight, walk.told};
    const bool estimated = next_event.meet(walk.coverage, meeting, sums);
    next_event.leave(walk.coverage, meeting, estimated, mirrored);
  }

  /// At the bottom or the top, where light gets out.
  Leg at_face(Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums, double distance) {
    const bool upward = s_.light.kz > 0.0;
    const int side = static_cast<int>(upward ? Side::kTop : Side::kBottom);
    if (side == plate_.pattern_side) {
      const std::size_t cell = cells_.cell(cells_.column(s_.x), cells_.row(s_.y));
      if (estimates_ && progress.owes(NextEvent::estimates(cells_.depth(cell)))) estimate_pattern(walk, 0, 0.0, sums);
      if (arrives_at_pattern(0, 0.0, progress, rng)) return meet_pattern(distance);
    }
    pass_levels(walk, upward ? 1 : 0, 1);
    s_.z = s_.plane(side);
    Light& k = s_.light;
    if (s_.face.reflects(k, rng)) {
      s_.face.reflect(k);
      k.kz = -k.kz;
      return Leg::kReflected;
    }
    const double n = plate_.refractive_index;
    s_.face.pass(k);
    k.kx *= n;
    k.ky *= n;
    k.kz = std::copysign(s_.face.cos_t, k.kz);
    s_.clamp_into_plate();
    walk.corner = -1;
    s_.leave(walk.photon, plate_.quads[static_cast<std::size_t>(side)], k.stokes());
    return upward && plate_.open_above ? Leg::kEscaped : Leg::kLeft;
  }

  /// From air at the bottom or the top; false: reflected there.
  bool passes_face_inwards(Walk& walk, int side, core::PhotonRng& rng) {
    Light& k = s_.light;
    pass_levels(walk, side == static_cast<int>(Side::kTop) ? 1 : 0, 1);
    walk.corner = -1;
    const double n = plate_.refractive_index;
    const PlateFresnel face(std::abs(k.kz), 1.0, n);
    if (face.reflects(k, rng)) {
      face.reflect(k);
      k.kz = -k.kz;
      s_.leave(walk.photon, plate_.quads[static_cast<std::size_t>(side)], k.stokes());
      return false;
    }
    face.pass(k);
    k.kx *= plate_.per_index;
    k.ky *= plate_.per_index;
    k.kz = std::copysign(face.cos_t, k.kz);
    s_.turned();
    return true;
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
  const PlanarCells& cells_;
  const PhotonHistory& history_;
  const Scene& scene_;
  Observer& observer_;
  PlanarPlateState<Light> s_;
  std::array<int, 2> level_{-1, -1};  ///< of bottom and top (`ViewerLevels`)
  bool estimates_ = false;            ///< is the luminance estimated at the pattern?
  int absorber_ = 0;
  int hit_quad_ = -1;
  double hit_distance_ = 0.0;
  PhotonHistory::Encounter encounter_;
};

}  // namespace evenglow::tracer
