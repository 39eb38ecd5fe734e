#include "tracer/transport/planar_scene.h"

#include <cmath>
#include <limits>

namespace evenglow::tracer {
namespace {

using core::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Along one axis: the side that a ray runs against and its distance.
struct Ahead {
  int side = 0;
  double distance = kInfinity;
};

Ahead ahead(const Box& box, const Vec3& p, const Vec3& k, int axis) {
  if (k[axis] > 0.0) return {2 * axis + 1, (box.max[axis] - p[axis]) / k[axis]};
  if (k[axis] < 0.0) return {2 * axis, (box.min[axis] - p[axis]) / k[axis]};
  return {2 * axis, kInfinity};
}

/// Where a ray that starts in the room leaves it, on the plane of that side exactly and within its rectangle.
RayHit exit_of(const PlanarRoom& room, const Vec3& p, const Vec3& k) {
  Ahead nearest = ahead(room.box, p, k, 2);
  // Most flights end above or below; beside the room only where x or y are left.
  const double x = p.x() + nearest.distance * k.x();
  const double y = p.y() + nearest.distance * k.y();
  const Box& box = room.box;
  if (!(x >= box.min.x() && x <= box.max.x() && y >= box.min.y() && y <= box.max.y())) {
    for (int axis = 0; axis < 2; ++axis) {
      const Ahead other = ahead(box, p, k, axis);
      if (other.distance < nearest.distance) nearest = other;
    }
  }
  const double t = std::max(0.0, nearest.distance);
  Vec3 at = (p + t * k).cwiseMax(box.min).cwiseMin(box.max);
  at[nearest.side / 2] = box.plane(static_cast<Side>(nearest.side));
  return {room.quads[static_cast<std::size_t>(nearest.side)], t, at};
}

}  // namespace

int PlanarScene::room_at(const Vec3& p, const Vec3& k) const {
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const Box& box = rooms_[i].box;
    const bool below_top = p.z() < box.max.z() || (p.z() == box.max.z() && k.z() < 0.0);
    const bool above_bottom = p.z() > box.min.z() || (p.z() == box.min.z() && k.z() > 0.0);
    if (!below_top || !above_bottom) continue;
    const bool inside = p.x() >= box.min.x() && p.x() <= box.max.x() && p.y() >= box.min.y() && p.y() <= box.max.y();
    return inside ? static_cast<int>(i) : kUnknown;
  }
  return kUnknown;
}

int PlanarScene::room_of(const Photon& photon) const {
  const Vec3& k = photon.light.frame.k;
  if (photon.quad < 0) {
    const int room = room_at(photon.position, k);
    return room >= 0 && rooms_[static_cast<std::size_t>(room)].body >= 0 ? kUnknown : room;
  }
  const Place& place = places_[static_cast<std::size_t>(photon.quad)];
  if (place.is_plate) return 0;
  if (place.is_sheet_side) return kBetweenWalls;
  if (!place.is_wall) return k.z() > 0.0 ? place.above : place.below;
  const int room = room_at(photon.position, k);
  return room >= 0 && rooms_[static_cast<std::size_t>(room)].body >= 0 ? kBetweenWalls : room;
}

std::optional<RayHit> PlanarScene::between_walls(const Photon& photon) const {
  const Place& place = places_[static_cast<std::size_t>(photon.quad)];
  const Vec3& k = photon.light.frame.k;
  if (place.is_wall) {  // into the sheet
    const PlanarRoom& room = rooms_[static_cast<std::size_t>(room_at(photon.position, k))];
    for (std::size_t side = 0; side < 4; ++side) {
      if (walls_[side] == photon.quad) return RayHit{room.quads[side], 0.0, photon.position};
    }
    return std::nullopt;
  }
  for (const PlanarRoom& room : rooms_) {  // out of it
    for (std::size_t side = 0; side < 4; ++side) {
      if (room.quads[side] == photon.quad) return RayHit{walls_[side], 0.0, photon.position};
    }
  }
  return std::nullopt;
}

std::optional<RayHit> PlanarScene::wall_of_plate(const Photon& photon) const {
  const Vec3& p = photon.position;
  const Vec3& k = photon.light.frame.k;
  const Box& box = plate_->box;
  for (int axis = 0; axis < 2; ++axis) {
    const bool from_low = k[axis] > 0.0 && p[axis] <= box.min[axis];
    if (!from_low && !(k[axis] < 0.0 && p[axis] >= box.max[axis])) continue;
    const double at = from_low ? box.min[axis] : box.max[axis];
    const double t = (at - p[axis]) / k[axis];
    const int across = 1 - axis;
    const double other = p[across] + t * k[across];
    const double z = p.z() + t * k.z();
    if (!(other > box.min[across] && other < box.max[across] && z > box.min.z() && z < box.max.z())) continue;
    Vec3 place(0.0, 0.0, z);
    place[axis] = at;
    place[across] = other;
    return RayHit{plate_->quads[2 * static_cast<std::size_t>(axis) + (from_low ? 0 : 1)], t, place};
  }
  return std::nullopt;
}

std::optional<RayHit> PlanarScene::entry_of_plate(const Photon& photon) const {
  const Vec3& p = photon.position;
  const Vec3& k = photon.light.frame.k;
  const Box& box = plate_->box;
  const bool from_above = k.z() < 0.0 && p.z() >= box.max.z();
  if (from_above || (k.z() > 0.0 && p.z() <= box.min.z())) {  // as most light does
    const std::size_t side = static_cast<std::size_t>(from_above ? Side::kTop : Side::kBottom);
    const double z = from_above ? box.max.z() : box.min.z();
    const double t = (z - p.z()) / k.z();
    const double x = p.x() + t * k.x();
    const double y = p.y() + t * k.y();
    if (x > box.min.x() && x < box.max.x() && y > box.min.y() && y < box.max.y()) {
      return RayHit{plate_->quads[side], t, {x, y, z}};
    }
  }
  if (auto wall = wall_of_plate(photon)) return wall;
  double enter = -kInfinity;
  double leave = kInfinity;
  int side = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (k[axis] == 0.0) {
      if (p[axis] < box.min[axis] || p[axis] > box.max[axis]) return std::nullopt;
      continue;
    }
    const double inverse = 1.0 / k[axis];
    const double a = (box.min[axis] - p[axis]) * inverse;
    const double b = (box.max[axis] - p[axis]) * inverse;
    const double near = std::min(a, b);
    if (near > enter) {
      enter = near;
      side = 2 * axis + (k[axis] > 0.0 ? 0 : 1);
    }
    leave = std::min(leave, std::max(a, b));
  }
  // Where reflector and plate touch, rounding may put the plate a little behind.
  constexpr double kSlack = 1e-9;
  if (enter < -kSlack || enter >= leave) return std::nullopt;
  const double t = std::max(0.0, enter);
  Vec3 at = (p + t * k).cwiseMax(box.min).cwiseMin(box.max);
  at[side / 2] = box.plane(static_cast<Side>(side));
  return RayHit{plate_->quads[static_cast<std::size_t>(side)], t, at};
}

bool PlanarScene::passes_free_source(const Vec3& from, const Vec3& to) const {
  for (int side = 0; side < kSides; ++side) {
    if (!free_sources_[static_cast<std::size_t>(side)]) continue;
    const int axis = side / 2;
    const double plane = area_.plane(static_cast<Side>(side));
    const double beyond =
        side % 2 == 1 ? std::max(from[axis], to[axis]) - plane : plane - std::min(from[axis], to[axis]);
    if (beyond >= 0.0) return true;
  }
  return false;
}

std::optional<RayHit> PlanarScene::next_hit(const Photon& photon) const {
  const Vec3& p = photon.position;
  const Vec3& k = photon.light.frame.k;
  if (photon.body >= 0) {
    const bool in_plate = plate_ && plate_->body == photon.body;
    return exit_of(
        in_plate ? *plate_ : rooms_[static_cast<std::size_t>(room_of_body_[static_cast<std::size_t>(photon.body)])], p,
        k);
  }
  const int index = room_of(photon);
  if (index == kOutside) return RayHit{-1, 0.0, p};
  if (index == kUnknown) return std::nullopt;
  if (index == kBetweenWalls) return between_walls(photon);
  const auto exit = [&] { return exit_of(rooms_[static_cast<std::size_t>(index)], p, k); };
  if (index > 0) return exit();
  if (has_free_sources_ && passes_free_source(p, exit().position)) return std::nullopt;
  const bool leaves_plate = photon.quad >= 0 && places_[static_cast<std::size_t>(photon.quad)].is_plate;
  if (plate_ && !leaves_plate) {
    if (auto entry = entry_of_plate(photon)) return entry;
  }
  return exit();
}

}  // namespace evenglow::tracer
