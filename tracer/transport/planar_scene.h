#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tracer/geometry/ray_caster.h"
#include "tracer/optics/photon.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// A box of air or of one dielectric body between two of the parallel layers.
struct PlanarRoom {
  Box box;
  int body = -1;                                          ///< -1: air
  std::array<int, kSides> quads{-1, -1, -1, -1, -1, -1};  ///< at each side; -1: light leaves the backlight there
};

/// A scene as a stack of parallel layers over a box-shaped plate: everything lies in planes x, y or z = const, films,
/// sheets and reflectors fill the room between the side walls. Then flights need no ray tracing: each ends at a side of
/// the box that it is in. Same quads and surfaces as the general path.
class PlanarScene {
 public:
  /// Empty if the scene is no such stack; then `reason` says why.
  static std::optional<PlanarScene> of(const Scene& scene, std::string* reason = nullptr);

  /// The plate, if the scene has one; its `body` and faces.
  const std::optional<PlanarRoom>& plate() const { return plate_; }
  /// Rooms between the layers, from below; the plate stands in the first one.
  const std::vector<PlanarRoom>& rooms() const { return rooms_; }
  /// Does light that goes up from this quad meet nothing more?
  bool is_last(int quad) const { return places_[static_cast<std::size_t>(quad)].above == kOutside; }
  /// Quad of the reflector at a side, -1: none.
  int wall(Side side) const { return walls_[static_cast<std::size_t>(side)]; }
  /// Is there nothing above the plate?
  bool is_open_above_plate() const {
    const PlanarRoom& room = rooms_.front();
    return plate_ && room.quads[static_cast<std::size_t>(Side::kTop)] < 0 && room.box.max.z() == plate_->box.max.z() &&
           !has_free_source(Side::kTop);
  }
  /// Does a source stand free beyond this side of the plate?
  bool has_free_source(Side side) const { return free_sources_[static_cast<std::size_t>(side)]; }

  /// Nearest surface (quad -1: the photon escapes) of a photon in air or in a body. Empty where only the general search
  /// can tell: a photon outside the layers, or beside the plate where a source stands free.
  std::optional<RayHit> next_hit(const Photon& photon) const;
  /// The wall of the plate that a photon in the air beside the plate meets; empty: `next_hit` may tell.
  std::optional<RayHit> wall_ahead(const Photon& photon) const {
    if (!plate_ || photon.body >= 0 || has_free_sources_) return std::nullopt;
    const core::Vec3& p = photon.position;
    const Box& room = rooms_.front().box;
    const bool beside = p.z() >= plate_->box.min.z() && p.z() <= plate_->box.max.z() && p.x() >= room.min.x() &&
                        p.x() <= room.max.x() && p.y() >= room.min.y() && p.y() <= room.max.y();
    if (!beside) return std::nullopt;
    return wall_of_plate(photon);
  }

 private:
  class Builder;
  /// Room of a photon in air: an index, or one of these.
  static constexpr int kOutside = -1;       ///< it meets nothing more
  static constexpr int kUnknown = -2;       ///< ask the general search
  static constexpr int kBetweenWalls = -3;  ///< between the side of a sheet and the wall that it touches
  int room_of(const Photon& photon) const;
  int room_at(const core::Vec3& position, const core::Vec3& k) const;
  std::optional<RayHit> between_walls(const Photon& photon) const;
  /// The wall of the plate that light beside it meets, if it meets one within its borders.
  std::optional<RayHit> wall_of_plate(const Photon& photon) const;
  /// Where light beside the plate comes to it.
  std::optional<RayHit> entry_of_plate(const Photon& photon) const;
  bool passes_free_source(const core::Vec3& from, const core::Vec3& to) const;

  /// What the rooms on both sides of a quad are.
  struct Place {
    int below = kUnknown, above = kUnknown;  ///< of a horizontal quad
    bool is_plate = false, is_wall = false, is_sheet_side = false;
  };
  std::vector<PlanarRoom> rooms_;  ///< from below
  std::vector<int> room_of_body_;
  std::vector<Place> places_;  ///< of each quad
  std::optional<PlanarRoom> plate_;
  Box area_;
  std::array<int, kSides> walls_{-1, -1, -1, -1, -1, -1};
  std::array<bool, kSides> free_sources_{};  ///< beyond this side of the plate
  bool has_free_sources_ = false;
};

}  // namespace evenglow::tracer
