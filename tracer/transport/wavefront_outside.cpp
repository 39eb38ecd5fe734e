#include "tracer/transport/wavefront_outside.h"

#include "tracer/transport/planar_face.h"
#include "tracer/transport/planar_wall.h"

namespace evenglow::tracer {

bool WavefrontOutside::start(Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  walk = history_.start(rng);
  walk.told = NextEvent::PatternTold::kDone;
  progress_ = {};
  if (plate_.pattern != nullptr) progress_.begin_pattern(rng);
  return follow(where(walk), walk, rng, sums);
}

bool WavefrontOutside::go_on(LaneExit exit, int side, int part, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  return follow(leave(exit, side, part, walk, rng, sums), walk, rng, sums);
}

WavefrontOutside::Place WavefrontOutside::leave(LaneExit exit, int side, int part, Walk& walk, core::PhotonRng& rng,
                                                BatchSums& sums) {
  Photon& photon = walk.photon;
  walk.corner = -1;
  const int bottom = static_cast<int>(Side::kBottom);
  switch (exit) {
    case LaneExit::kNone:
    case LaneExit::kEmpty:
      break;
    case LaneExit::kAbsorbed:
      sums.energy[scene_.energy.absorbed_bin(part)] += walk.weight.y();
      return Place::kEnded;
    case LaneExit::kStuck:
      progress_.events = PhotonHistory::kMaxEvents;
      return Place::kAir;
    case LaneExit::kEscaped:
      photon.position = state_.position();
      photon.light.frame.k = {state_.light.kx, state_.light.ky, state_.light.kz};
      history_.escape(walk, sums);
      return Place::kEnded;
    case LaneExit::kTop:
      state_.z = state_.plane(static_cast<int>(Side::kTop));
      state_.leave(photon, plate_quad(static_cast<int>(Side::kTop)), state_.light.stokes());
      break;
    case LaneExit::kBottom:
      state_.z = state_.plane(bottom);
      state_.leave(photon, plate_quad(bottom), state_.light.stokes());
      break;
    case LaneExit::kReflector:
      state_.z = scene_.caster->quads()[static_cast<std::size_t>(quad_below_)].corner.z();
      state_.leave(photon, quad_below_, state_.light.stokes());
      break;
    case LaneExit::kWallInside:
      state_.clamp_into_plate();
      photon.light = state_.light.stokes();
      photon.body = plate_.body;
      ++progress_.events;
      return interact(walk, {plate_quad(side), 0.0, state_.position()}, optics_of(plate_quad(side)), rng, sums);
    case LaneExit::kWall:
      leave_by_wall(side, plate_quad(side), walk);
      break;
    case LaneExit::kBacking:
      leave_by_wall(side, plate_.backings[static_cast<std::size_t>(side)].quad, walk);
      break;
    case LaneExit::kPattern:
    case LaneExit::kPatternOutside: {
      const int quad = plate_quad(plate_.pattern_side);
      photon.light = state_.light.stokes();
      photon.body = exit == LaneExit::kPattern ? plate_.body : -1;
      photon.quad = exit == LaneExit::kPattern ? -1 : quad_below_;
      return interact(walk, {quad, 1.0, state_.position()}, {plate_.pattern, plate_.pattern_part}, rng, sums);
    }
  }
  return Place::kAir;
}

void WavefrontOutside::leave_by_wall(int side, int quad, Walk& walk) {
  const bool x_wall = side < 2;
  const bool is_wall = quad == plate_quad(side);
  const double behind = is_wall ? 0.0 : plate_.backings[static_cast<std::size_t>(side)].gap;
  state_.clamp_into_plate();
  (x_wall ? state_.x : state_.y) = state_.plane(side) + (side % 2 != 0 ? behind : -behind);
  const core::Vec3 k(state_.light.kx, state_.light.ky, state_.light.kz);
  const core::Vec3 s = across_wall(k, x_wall);
  state_.leave(walk.photon, quad, state_.light.stokes_in({k, s.cross(k)}));
}

bool WavefrontOutside::follow(Place place, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  while (place == Place::kAir && progress_.events < PhotonHistory::kMaxEvents) place = step(walk, rng, sums);
  if (place == Place::kPlate) return true;
  sums.events[0] += static_cast<double>(progress_.events);
  if (place == Place::kAir) sums.energy[scene_.energy.lost_bin(LossReason::kStuck)] += 1.0;
  return false;
}

WavefrontOutside::Place WavefrontOutside::step(Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  ++progress_.events;
  const std::optional<RayHit> hit = layout_.next_hit(walk.photon);
  if (!hit) return general_step(walk, rng, sums);
  if (hit->quad < 0) {
    history_.escape(walk, sums);
    return Place::kEnded;
  }
  if (walk.photon.body < 0) {
    const int side = plate_.side_of(hit->quad);
    if (side >= 0) return enter(walk, *hit, side, rng, sums);
  } else {
    switch (history_.fly(walk, hit->distance, rng, sums)) {
      case PhotonHistory::Flight::kAbsorbed:
        return Place::kEnded;
      case PhotonHistory::Flight::kScattered:
        return Place::kAir;
      case PhotonHistory::Flight::kArrived:
        break;
    }
  }
  return history_.interact(walk, *hit, rng, sums) ? where(walk) : Place::kEnded;
}

WavefrontOutside::Place WavefrontOutside::general_step(Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  return history_.step(walk, rng, sums) ? where(walk) : Place::kEnded;
}

WavefrontOutside::Place WavefrontOutside::enter(Walk& walk, const RayHit& hit, int side, core::PhotonRng& rng,
                                                BatchSums& sums) {
  state_.x = hit.position.x();
  state_.y = hit.position.y();
  state_.z = hit.position.z();
  bool inside = false;
  if (side >= 4) {
    state_.light = MeridianLight(walk.photon.light);
    if (side == plate_.pattern_side && meets_pattern(rng)) {
      return interact(walk, hit, {plate_.pattern, plate_.pattern_part}, rng, sums);
    }
    inside = PlanarFace<MeridianLight>(state_, side).lets_in(walk.photon, rng);
  } else {
    if (!plate_.smooth[static_cast<std::size_t>(side)]) return interact(walk, hit, optics_of(hit.quad), rng, sums);
    inside = PlanarWall<MeridianLight>(state_, side).from_outside(walk.photon, rng) == WallEnd::kInside;
  }
  walk.corner = -1;
  if (!inside) return Place::kAir;
  walk.photon.body = plate_.body;
  return Place::kPlate;
}

bool WavefrontOutside::meets_pattern(core::PhotonRng& rng) {
  return progress_.meets(cells_.open(cells_.cell(cells_.column(state_.x), cells_.row(state_.y))), rng);
}

WavefrontOutside::Place WavefrontOutside::interact(Walk& walk, const RayHit& hit,
                                                   const PhotonHistory::Encounter& encounter, core::PhotonRng& rng,
                                                   BatchSums& sums) {
  return history_.interact(walk, hit, encounter, rng, sums) ? where(walk) : Place::kEnded;
}

WavefrontOutside::Place WavefrontOutside::where(const Walk& walk) {
  if (walk.photon.body != plate_.body) return Place::kAir;
  state_.load(walk.photon);
  return Place::kPlate;
}

}  // namespace evenglow::tracer
