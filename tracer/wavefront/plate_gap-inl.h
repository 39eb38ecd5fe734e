// Many photons at horizontal reflectors: the pattern, and the sheet below the plate with the air between. Included
// once for each instruction set.
#include "tracer/wavefront/lane_state-inl.h"
#include "tracer/wavefront/plate_constants.h"

#if defined(EVENGLOW_PLATE_GAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_PLATE_GAP_INL_H
#undef EVENGLOW_PLATE_GAP_INL_H
#else
#define EVENGLOW_PLATE_GAP_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

/// What the walk inside and that below the plate share, and the latter.
class HorizontalStep {
 public:
  HWY_INLINE explicit HorizontalStep(const PlateConstants& plate) : p_(plate) {}

  /// 1 - density at a place.
  HWY_INLINE Number open_at(Number column, Number row) const {
    const Number zero = all(0.0);
    column = hn::Floor(hn::Min(hn::Max(column, zero), all(p_.nx - 1)));
    row = hn::Floor(hn::Min(hn::Max(row, zero), all(p_.ny - 1)));
    // A whole number below 2^23 stands in the last bits of itself plus 2^23.
    const hn::RebindToSigned<Tag> index;
    const Number shift = all(0x1.0p23);
    const auto cell = hn::Xor(hn::BitCast(index, row * all(p_.nx) + column + shift), hn::BitCast(index, shift));
    return hn::GatherIndex(Tag(), p_.open.data(), cell);
  }

  /// The pattern has been met.
  HWY_INLINE void renew_fate(State& s, Lanes met) const {
    const Number u = s.random.uniform(met);
    s.fate = pick(met, u, s.fate);
    s.missed = pick(met, all(1.0), s.missed);
  }

  /// By a flat reflector, horizontal, that the light has come to.
  HWY_INLINE void reflect_at(State& s, Lanes lanes, const FlatReflector& by, Number u, Number u1, Number u2) const {
    s.absorb(hn::And(lanes, u >= all(by.reflectance)), all(by.part));
    const Lanes mirrored = hn::And(lanes, u < all(by.mirrored));
    s.light.mirror(mirrored);
    const Number back = hn::Neg(s.kz);
    s.kz = pick(mirrored, back, s.kz);
    const Lanes scattered = but_not(hn::And(lanes, u < all(by.reflectance)), mirrored);
    s.light.forget(scattered);
    s.aim(scattered, lambertian(u1, u2), back);
  }

  /// Light in air that leaves the bottom, to and fro between it and the reflector below.
  HWY_INLINE void go_below(State& s, Lanes below) const {
    const Number index = all(p_.per_index);
    while (any(below)) {
      const Lanes down = cross_gap_below(s, below);
      s.leave(but_not(below, down), LaneExit::kBottom);
      s.count(down, all(1.0));
      const Number u = s.random.uniform(down);
      const Number u1 = s.random.uniform(down);
      const Number u2 = s.random.uniform(down);
      reflect_at(s, down, p_.below, u, u1, u2);
      const Lanes back = hn::And(down, u < all(p_.below.reflectance));
      const Lanes up = cross_gap_below(s, back);
      s.leave(but_not(back, up), LaneExit::kReflector);
      s.count(up, all(1.0));
      const Lanes met = p_.pattern_side == 4 ? meets_from_outside(s, up) : s.kz > all(2.0);
      const Lanes bare = but_not(up, met);
      const Number u3 = s.random.uniform(bare);
      const Face face(hn::Abs(s.kz), index);
      const Amplitudes amplitudes(face.c, face.root, index);
      const Lanes reflected = hn::And(bare, amplitudes.reflects(s.light, u3));
      amplitudes.reflect(s.light, reflected);
      s.kz = pick(reflected, hn::Neg(s.kz), s.kz);
      const Lanes inside = but_not(bare, reflected);
      amplitudes.pass(s.light, inside);
      s.kx = pick(inside, s.kx * index, s.kx);
      s.ky = pick(inside, s.ky * index, s.ky);
      s.kz = pick(inside, face.root, s.kz);
      s.light.rescale();
      below = hn::Or(reflected, scattered_at_pattern(s, met));
    }
  }

 private:
  /// Those that reach the other side before the plate's; the others stay where they are.
  HWY_INLINE Lanes cross_gap_below(State& s, Lanes lanes) const {
    const Number way = all(p_.below.gap) / hn::Max(hn::Abs(s.kz), all(1e-12));
    const Number x = s.x + s.kx * way;
    const Number y = s.y + s.ky * way;
    const Lanes in_x = hn::And(x > all(p_.min_x), x < all(p_.max_x));
    const Lanes in_y = hn::And(y > all(p_.min_y), y < all(p_.max_y));
    const Lanes crossed = hn::And(lanes, hn::And(in_x, in_y));
    s.x = pick(crossed, x, s.x);
    s.y = pick(crossed, y, s.y);
    return crossed;
  }

  HWY_INLINE Lanes meets_from_outside(State& s, Lanes lanes) const {
    const Number open = open_at((s.x - all(p_.x0)) * all(p_.per_x), (s.y - all(p_.y0)) * all(p_.per_y));
    s.missed = pick(lanes, s.missed * open, s.missed);
    const Lanes met = hn::And(lanes, s.missed < s.fate);
    renew_fate(s, met);
    return met;
  }

  /// Light in air that meets the pattern from below; lanes that go down again.
  HWY_INLINE Lanes scattered_at_pattern(State& s, Lanes met) const {
    if (!any(met)) return met;
    if (p_.dots.known == 0.0) {
      s.leave(met, LaneExit::kPatternOutside);
      return hn::And(met, hn::Not(met));
    }
    const Number u = s.random.uniform(met);
    const Number u1 = s.random.uniform(met);
    const Number u2 = s.random.uniform(met);
    reflect_at(s, met, p_.dots, u, u1, u2);
    return hn::And(met, u < all(p_.dots.reflectance));
  }

  const PlateConstants& p_;
};

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
