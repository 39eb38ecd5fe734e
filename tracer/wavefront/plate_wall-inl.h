// Many photons at smooth walls of the plate and before the reflectors behind them: `PlanarWall` of
// tracer/transport/planar_wall.h, lane by lane. Included once for each instruction set.
#include "tracer/wavefront/lane_state-inl.h"
#include "tracer/wavefront/plate_constants.h"

#if defined(EVENGLOW_PLATE_WALL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_PLATE_WALL_INL_H
#undef EVENGLOW_PLATE_WALL_INL_H
#else
#define EVENGLOW_PLATE_WALL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

/// What becomes of the lanes that have come to a wall from inside. Where light goes to and fro behind the wall more
/// than once (a few percent do), the lane is left to the scalar path.
class WallStep {
 public:
  HWY_INLINE WallStep(const PlateConstants& plate, State& s, Lanes lanes, Lanes x_wall)
      : p_(plate),
        s_(s),
        lanes_(lanes),
        x_wall_(x_wall),
        n_(all(plate.index)),
        sign_(pick(x_wall, all(1.0), all(-1.0))),
        kn_(pick(x_wall, s.kx, s.ky)),
        kt_(pick(x_wall, s.ky, s.kx)),
        upper_(kn_ > all(0.0)) {}

  /// Two uniform numbers.
  HWY_INLINE void meet(Number u, Number u1) {
    const Number side = pick(x_wall_, all(0.0), all(2.0)) + hn::IfThenElseZero(upper_, all(1.0));
    s_.side = pick(lanes_, side, s_.side);
    const Number plane =
        pick(x_wall_, pick(upper_, all(p_.max_x), all(p_.min_x)), pick(upper_, all(p_.max_y), all(p_.min_y)));
    s_.x = pick(hn::And(lanes_, x_wall_), plane, s_.x);
    s_.y = pick(but_not(lanes_, x_wall_), plane, s_.y);
    leave_rough_walls();

    const Face wall(hn::Abs(kn_), n_);
    const Turn turn = wall_turn(kn_, kt_, s_.kz, sign_);
    const Amplitudes amplitudes(wall.c, wall.root, n_);
    const Lanes total = hn::And(lanes_, wall.total);
    s_.light.turn_frame(lanes_, turn);
    s_.light.turn_phase(total, total_phase(wall, n_));
    const Lanes reflected = hn::And(but_not(lanes_, total), amplitudes.reflects(s_.light, u));
    amplitudes.reflect(s_.light, reflected);
    const Lanes inside = hn::Or(total, reflected);
    s_.light.turn_frame(inside, turn);
    const Lanes passed = but_not(lanes_, inside);
    const Number inside_n = kn_, inside_t = kt_, inside_z = s_.kz;
    kn_ = pick(inside, hn::Neg(kn_), kn_);
    if (any(passed)) {
      amplitudes.pass(s_.light, passed);
      turn_out(passed, wall);
      const Lanes back = mirrored_back(passed, amplitudes, u1);
      amplitudes.pass(s_.light, back);
      kn_ = pick(back, hn::Neg(inside_n), kn_);
      kt_ = pick(back, inside_t, kt_);
      s_.kz = pick(back, inside_z, s_.kz);
      s_.light.turn_frame(back, turn);
    }
    aim();
  }

  /// From outside: the lanes are natural light in air at the wall `side`, which is smooth.
  HWY_INLINE void meet_from_outside() {
    enter(lanes_);
    aim();
  }

 private:
  HWY_INLINE void aim() {
    s_.kx = pick(lanes_, pick(x_wall_, kn_, kt_), s_.kx);
    s_.ky = pick(lanes_, pick(x_wall_, kt_, kn_), s_.ky);
  }

  HWY_INLINE Number of_wall(const std::array<double, 4>& values) const {
    return pick(x_wall_, pick(upper_, all(values[1]), all(values[0])), pick(upper_, all(values[3]), all(values[2])));
  }

  HWY_INLINE void leave_rough_walls() {
    if (p_.all_smooth) return;
    const Lanes rough = hn::And(lanes_, of_wall(p_.smooth) == all(0.0));
    s_.leave(rough, LaneExit::kWallInside);
    s_.count(rough, all(-1.0));  // the scalar path meets the wall
    lanes_ = but_not(lanes_, rough);
  }

  HWY_INLINE void turn_out(Lanes lanes, const Face& wall) {
    kn_ = pick(lanes, hn::CopySignToAbs(wall.root, kn_), kn_);
    kt_ = pick(lanes, kt_ * n_, kt_);
    s_.kz = pick(lanes, s_.kz * n_, s_.kz);
  }

  /// Light that has passed the wall; lanes that come back to it by a mirror and pass it again.
  HWY_INLINE Lanes mirrored_back(Lanes passed, const Amplitudes& amplitudes, Number u) {
    const Lanes known = hn::And(passed, of_wall(p_.backing_known) != all(0.0));
    const Number gap = of_wall(p_.backing_gap);
    const Number way = gap / hn::Max(hn::Abs(kn_), all(1e-12));
    const Lanes there = cross_gap(known, way);
    s_.leave(but_not(passed, there), LaneExit::kWall);
    s_.count(there, all(1.0));
    const Lanes kept = hn::And(there, u < of_wall(p_.backing_reflectance));
    s_.absorb(but_not(there, kept), of_wall(p_.backing_part));
    const Lanes mirrored = hn::And(kept, u < of_wall(p_.backing_mirrored));
    const Lanes scattered = but_not(kept, mirrored);
    if (any(scattered)) scatter_back(scattered, gap);
    s_.light.mirror(mirrored);
    kn_ = pick(mirrored, hn::Neg(kn_), kn_);
    const Lanes back = cross_gap(mirrored, way);
    s_.leave(but_not(mirrored, back), LaneExit::kBacking);
    s_.count(back, all(1.0));
    const Number again = s_.random.uniform(back);
    const Lanes reflected = hn::And(back, amplitudes.reflects(s_.light, again));
    amplitudes.reflect(s_.light, reflected);
    kn_ = pick(reflected, hn::Neg(kn_), kn_);
    s_.leave(reflected, LaneExit::kWall);
    return but_not(back, reflected);
  }

  /// Light that the white reflector behind the wall sends back.
  HWY_INLINE void scatter_back(Lanes lanes, Number gap) {
    const Number u1 = s_.random.uniform(lanes);
    const Number u2 = s_.random.uniform(lanes);
    const Direction d = lambertian(u1, u2);
    s_.light.forget(lanes);
    kn_ = pick(lanes, hn::CopySignToAbs(d.z, hn::Neg(kn_)), kn_);
    kt_ = pick(lanes, d.x, kt_);
    s_.kz = pick(lanes, d.y, s_.kz);
    const Lanes there = cross_gap(lanes, gap / hn::Max(hn::Abs(kn_), all(1e-12)));
    s_.leave(but_not(lanes, there), LaneExit::kBacking);
    s_.count(there, all(1.0));
    enter(there);
  }

  /// Light in air that has come to the wall.
  HWY_INLINE void enter(Lanes there) {
    const Number index = all(p_.per_index);
    const Face face(hn::Abs(kn_), index);
    const Amplitudes amplitudes(face.c, face.root, index);
    const Number u3 = s_.random.uniform(there);
    const Lanes reflected = hn::And(there, amplitudes.reflects(s_.light, u3));
    amplitudes.reflect(s_.light, reflected);
    kn_ = pick(reflected, hn::Neg(kn_), kn_);
    s_.leave(reflected, LaneExit::kWall);
    const Lanes inside = but_not(there, reflected);
    amplitudes.pass(s_.light, inside);
    kn_ = pick(inside, hn::CopySignToAbs(face.root, kn_), kn_);
    kt_ = pick(inside, kt_ * index, kt_);
    s_.kz = pick(inside, s_.kz * index, s_.kz);
    const Turn turn = wall_turn(kn_, kt_, s_.kz, sign_);
    s_.light.turn_frame(inside, {turn.re, hn::Neg(turn.im)});
  }

  /// Along the ray for `way` (mm): those that get across before they leave what lies before the plate. The others stay
  /// where they are.
  HWY_INLINE Lanes cross_gap(Lanes lanes, Number way) {
    const Number t = pick(x_wall_, s_.y, s_.x) + kt_ * way;
    const Number z = s_.z + s_.kz * way;
    const Number min_t = pick(x_wall_, all(p_.min_y), all(p_.min_x));
    const Number max_t = pick(x_wall_, all(p_.max_y), all(p_.max_x));
    const Lanes in_t = hn::And(t > min_t, t < max_t);
    const Lanes in_z = hn::And(z > all(p_.min_z), z < all(p_.max_z));
    const Lanes crossed = hn::And(lanes, hn::Or(way == all(0.0), hn::And(in_t, in_z)));
    s_.x = pick(but_not(crossed, x_wall_), t, s_.x);
    s_.y = pick(hn::And(crossed, x_wall_), t, s_.y);
    s_.z = pick(crossed, z, s_.z);
    return crossed;
  }

  const PlateConstants& p_;
  State& s_;
  Lanes lanes_, x_wall_;
  Number n_, sign_, kn_, kt_;
  Lanes upper_;  ///< is it the wall of the greater x or y, for light from inside?
};

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
