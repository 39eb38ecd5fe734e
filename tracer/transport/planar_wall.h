#pragma once

#include <cmath>

#include "core/math/lambertian.h"
#include "tracer/transport/planar_plate_state.h"

namespace evenglow::tracer {

/// What became of light at a wall.
enum class WallEnd {
  kInside,   ///< it goes on in the plate
  kOutside,  ///< it goes on in air, as the photon
  kAbsorbed  ///< by the reflector behind the wall
};

/// A smooth side wall of the plate and the air behind it, up to a plain reflector that may stand there: light that
/// goes to and fro between the two is followed in the wall's plane of incidence. `kXWall`: one of x = const, else of
/// y = const.
template <typename Light, bool kXWall>
class PlanarWall {
 public:
  PlanarWall(PlanarPlateState<Light>& state, int side)
      : s_(state), side_(side), kn_(kXWall ? s_.light.kx : s_.light.ky), kt_(kXWall ? s_.light.ky : s_.light.kx) {}

  /// Light from inside that has come to the wall.
  [[gnu::always_inline]] WallEnd from_inside(Photon& photon, PlanarProgress& progress, core::PhotonRng& rng) {
    if (PlateFresnel::is_total(kn_, n()) && !s_.light.is_polarized()) {
      kn_ = -kn_;
      return WallEnd::kInside;
    }
    const PlateFresnel wall(std::abs(kn_), n());
    const WallTurn turn(kn_, kt_, s_.light.kz, kSign);
    s_.light.turn_frame(turn.cos2, turn.sin2);
    if (wall.total) {
      s_.light.turn_phase(wall.phase_re, wall.phase_im);
    } else if (!wall.reflects(s_.light, rng)) {
      return passed(photon, wall, turn, progress, rng);
    }
    kn_ = -kn_;
    s_.light.turn_frame(turn.cos2, turn.sin2);
    return WallEnd::kInside;
  }

  /// Light in air that has come to the wall at the state's place.
  WallEnd from_outside(Photon& photon, core::PhotonRng& rng) {
    const core::Vec3& k = photon.light.frame.k;
    s_.light.kx = k.x();
    s_.light.ky = k.y();
    s_.light.kz = k.z();
    if (photon.light.is_unpolarized()) {
      s_.light.forget_polarization();
    } else {
      s_.light.count_along(across_wall(k, kXWall), photon.light);
    }
    const PlateFresnel face(std::abs(kn_), s_.plate.per_index);
    if (face.reflects(s_.light, rng)) {
      kn_ = -kn_;
      return outside(photon, s_.plate.quads[static_cast<std::size_t>(side_)]);
    }
    go_in(face);
    return WallEnd::kInside;
  }

 private:
  double n() const { return s_.plate.refractive_index; }
  const WallBacking& backing() const { return s_.plate.backings[static_cast<std::size_t>(side_)]; }

  WallEnd passed(Photon& photon, const PlateFresnel& wall, const WallTurn& turn, PlanarProgress& progress,
                 core::PhotonRng& rng) {
    const double inside_n = kn_, inside_t = kt_, inside_z = s_.light.kz;
    wall.pass(s_.light);
    kt_ *= n();
    s_.light.kz *= n();
    kn_ = std::copysign(wall.cos_t, kn_);
    const int wall_quad = s_.plate.quads[static_cast<std::size_t>(side_)];
    if (!backing().reflector.known) return outside(photon, wall_quad);
    const double way = backing().gap / wall.cos_t;
    while (true) {
      if (!crosses_gap(way)) return outside(photon, wall_quad);
      ++progress.events;
      const double u = rng.uniform();
      if (u >= backing().reflector.reflectance) return WallEnd::kAbsorbed;
      if (u >= backing().reflector.mirrored) return scattered(photon, progress, rng);
      s_.light.mirror();
      kn_ = -kn_;
      if (!crosses_gap(way)) return outside(photon, backing().quad);
      ++progress.events;
      // From outside the face reflects as much, and both amplitudes change sign. u is uniform below `mirrored` now.
      if (!wall.reflects(s_.light, u * backing().reflector.per_mirrored)) break;
      kn_ = -kn_;
    }
    wall.pass(s_.light);
    // Inside again with the same angles: what was known of them holds.
    kn_ = -inside_n;
    kt_ = inside_t;
    s_.light.kz = inside_z;
    s_.light.turn_frame(turn.cos2, turn.sin2);
    return WallEnd::kInside;
  }

  /// By the white reflector behind the wall, where the light is.
  [[gnu::noinline]] WallEnd scattered(Photon& photon, PlanarProgress& progress, core::PhotonRng& rng) {
    while (true) {
      const core::Vec3 k = core::draw_lambertian(rng);
      s_.light.forget_polarization();
      kn_ = std::copysign(k.z(), side_ % 2 != 0 ? -1.0 : 1.0);
      kt_ = k.x();
      s_.light.kz = k.y();
      const double way = backing().gap / std::abs(kn_);
      if (!crosses_gap(way)) return outside(photon, backing().quad);
      ++progress.events;
      const PlateFresnel face(std::abs(kn_), s_.plate.per_index);
      if (!face.reflects(s_.light, rng)) {
        go_in(face);
        return WallEnd::kInside;
      }
      kn_ = -kn_;
      if (!crosses_gap(way)) return outside(photon, s_.plate.quads[static_cast<std::size_t>(side_)]);
      ++progress.events;
      const double u = rng.uniform();
      if (u >= backing().reflector.reflectance) return WallEnd::kAbsorbed;
      if (u < backing().reflector.mirrored) {
        s_.light.mirror();
        kn_ = -kn_;
        return outside(photon, backing().quad);
      }
    }
  }

  /// Through the wall into the plate; `face` as seen from the air.
  void go_in(const PlateFresnel& face) {
    face.pass(s_.light);
    kt_ *= s_.plate.per_index;
    s_.light.kz *= s_.plate.per_index;
    kn_ = std::copysign(face.cos_t, kn_);
    const WallTurn turn(kn_, kt_, s_.light.kz, kSign);
    s_.light.turn_frame(turn.cos2, -turn.sin2);
    s_.turned();
  }

  /// From wall to reflector or back, so far; false, and nothing done, if the ray leaves what lies before the plate.
  [[gnu::always_inline]] bool crosses_gap(double way) {
    if (way == 0.0) return true;
    const Box& box = s_.plate.box;
    double& t = kXWall ? s_.y : s_.x;
    const double to_t = t + kt_ * way;
    const double to_z = s_.z + s_.light.kz * way;
    const int axis = kXWall ? 1 : 0;
    if (!(to_t > box.min[axis] && to_t < box.max[axis] && to_z > box.min.z() && to_z < box.max.z())) return false;
    t = to_t;
    s_.z = to_z;
    return true;
  }

  /// Hands the light over as the photon, in air at this quad.
  [[gnu::noinline]] WallEnd outside(Photon& photon, int quad) {
    const double behind = quad == backing().quad ? backing().gap : 0.0;
    s_.clamp_into_plate();
    (kXWall ? s_.x : s_.y) = s_.plane(side_) + (side_ % 2 != 0 ? behind : -behind);
    const core::Vec3 k(s_.light.kx, s_.light.ky, s_.light.kz);
    const core::Vec3 s = across_wall(k, kXWall);
    s_.leave(photon, quad, s_.light.stokes_in({k, s.cross(k)}));
    return WallEnd::kOutside;
  }

  static constexpr double kSign = kXWall ? 1.0 : -1.0;  ///< of `WallTurn`

  PlanarPlateState<Light>& s_;
  int side_;
  double& kn_;
  double& kt_;
};

}  // namespace evenglow::tracer
