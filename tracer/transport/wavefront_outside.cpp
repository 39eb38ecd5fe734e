#include "tracer/transport/wavefront_outside.h"

#include <cmath>
#include <limits>

#include "tracer/transport/planar_face.h"
#include "tracer/transport/planar_wall.h"

namespace evenglow::tracer {

WavefrontOutside::WavefrontOutside(const Scene& scene, const PlanarScene& layout, const PhotonHistory& history,
                                   const PlanarPlate& plate, const PlanarCells& cells)
    : scene_(scene),
      layout_(layout),
      history_(history),
      plate_(plate),
      cells_(cells),
      quad_below_(layout.wall(Side::kBottom)),
      state_(plate) {
  for (std::size_t side = 0; side < 4; ++side) clear_[side] = clear_before(static_cast<Side>(side));
}

double WavefrontOutside::clear_before(Side side) const {
  const int wall = layout_.wall(side);
  const int axis = axis_of(side);
  double clear = std::numeric_limits<double>::infinity();
  if (wall >= 0) {
    const double at = scene_.caster->quads()[static_cast<std::size_t>(wall)].corner[axis];
    clear = std::abs(at - plate_.box.plane(side)) + 1e-9;
  }
  for (const auto& source : scene_.spec.sources) {
    if (source->side() == side) clear = std::min(clear, source->gap() + 1e-9);
  }
  return clear;
}

bool WavefrontOutside::start(Walk& walk, int& side, core::PhotonRng& rng, BatchSums& sums) {
  walk = history_.start(rng);
  walk.told = NextEvent::PatternTold::kDone;
  progress_ = {};
  if (plate_.pattern != nullptr) progress_.begin_pattern(rng);
  side = wall_ahead(walk.photon);
  if (side < 0) return follow(where(walk), walk, rng, sums);
  ++progress_.events;
  walk.photon.body = plate_.body;
  return true;
}

int WavefrontOutside::wall_ahead(const Photon& photon) {
  const core::Vec3& p = photon.position;
  const core::Vec3& k = photon.light.frame.k;
  if (photon.body >= 0 || !photon.light.is_unpolarized()) return -1;
  const Box& box = plate_.box;
  for (int axis = 0; axis < 2; ++axis) {
    const bool below = p[axis] <= box.min[axis] && k[axis] > 0.0;
    if (!below && !(p[axis] >= box.max[axis] && k[axis] < 0.0)) continue;
    const int side = 2 * axis + (below ? 0 : 1);
    if (!plate_.smooth[static_cast<std::size_t>(side)]) return -1;
    const double before = std::abs(state_.plane(side) - p[axis]);
    if (before > clear_[static_cast<std::size_t>(side)]) return -1;
    const double way = before / std::abs(k[axis]);
    const double across = p[1 - axis] + way * k[1 - axis];
    const double z = p.z() + way * k.z();
    const bool within = across > box.min[1 - axis] && across < box.max[1 - axis] && z > box.min.z() && z < box.max.z();
    if (!within) return -1;
    state_.x = axis == 0 ? state_.plane(side) : across;
    state_.y = axis == 0 ? across : state_.plane(side);
    state_.z = z;
    state_.light.kx = k.x();
    state_.light.ky = k.y();
    state_.light.kz = k.z();
    return side;
  }
  return -1;
}

void WavefrontOutside::escape(const core::Vec3& position, const core::Vec3& k, std::int64_t events, Walk& walk,
                              BatchSums& sums) const {
  sums.events[0] += static_cast<double>(events);
  walk.photon.position = position;
  walk.photon.light.frame.k = k;
  history_.escape_by(Side::kTop, walk, sums);
}

bool WavefrontOutside::go_on(LaneExit exit, int side, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
  return follow(leave(exit, side, walk, rng, sums), walk, rng, sums);
}

WavefrontOutside::Place WavefrontOutside::leave(LaneExit exit, int side, Walk& walk, core::PhotonRng& rng,
                                                BatchSums& sums) {
  Photon& photon = walk.photon;
  walk.corner = -1;
  state_.clamp_into_plate();
  const int bottom = static_cast<int>(Side::kBottom);
  switch (exit) {
    case LaneExit::kNone:
    case LaneExit::kEmpty:
    case LaneExit::kAbsorbed:
    case LaneExit::kEscaped:
    case LaneExit::kArrives:
      break;
    case LaneExit::kStuck:
      progress_.events = PhotonHistory::kMaxEvents;
      return Place::kAir;
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
    const WallEnd end = side < 2 ? PlanarWall<MeridianLight, true>(state_, side).from_outside(walk.photon, rng)
                                 : PlanarWall<MeridianLight, false>(state_, side).from_outside(walk.photon, rng);
    inside = end == WallEnd::kInside;
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
