// One step of many photons in the plate. Included once for each instruction set.
#include "tracer/wavefront/lane_state-inl.h"
#include "tracer/wavefront/plate_constants.h"
#include "tracer/wavefront/plate_gap-inl.h"
#include "tracer/wavefront/plate_wall-inl.h"

#if defined(EVENGLOW_PLATE_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_PLATE_STEP_INL_H
#undef EVENGLOW_PLATE_STEP_INL_H
#else
#define EVENGLOW_PLATE_STEP_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

/// Steps of one plate.
class Stepper {
 public:
  HWY_INLINE explicit Stepper(const PlateConstants& plate)
      : p_(plate),
        horizontal_(plate),
        min_x_(all(plate.min_x)),
        max_x_(all(plate.max_x)),
        min_y_(all(plate.min_y)),
        max_y_(all(plate.max_y)),
        min_z_(all(plate.min_z)),
        max_z_(all(plate.max_z)),
        n_(all(plate.index)) {}

  HWY_INLINE void step(State& s, Lanes active) const {
    const Face face(hn::Abs(s.kz), n_);
    const Flight f = fly(s, face, active);
    s.absorb(f.absorbed, all(p_.part));
    const Number u = s.random.uniform();
    const Number u1 = s.random.uniform();
    const Number u2 = s.random.uniform();
    if (any(f.met)) meet_pattern(s, f.met, u, u1, u2);
    if (any(f.at_face)) meet_face(s, face, f.at_face, u);
    if (any(f.at_wall)) WallStep(p_, s, f.at_wall, f.x_wall).meet(u, u1);
    s.light.rescale();
    const Lanes going = hn::And(active, hn::RebindMask(Tag(), hn::BitCast(WordTag(), s.exit) == hn::Zero(WordTag())));
    s.leave(hn::And(going, s.events >= all(p_.most_events)), LaneExit::kStuck);
  }

 private:
  /// Where the lanes have come to.
  struct Flight {
    Lanes absorbed, met, at_face, at_wall, x_wall;
  };

  /// All total reflections up to the next event; for light that the faces let out, one flight.
  HWY_INLINE Flight fly(State& s, const Face& face, Lanes active) const {
    const Number zero = all(0.0);
    const Number ax = hn::Max(hn::Abs(s.kx), all(1e-12));
    const Number ay = hn::Max(hn::Abs(s.ky), all(1e-12));
    const Number az = hn::Max(hn::Abs(s.kz), all(1e-12));
    const Number inverse = all(1.0) / (ax * ay * az);
    const Number way_z = inverse * (ax * ay);
    const Number to_x = pick(s.kx > zero, max_x_ - s.x, s.x - min_x_) * (inverse * (ay * az));
    const Number to_y = pick(s.ky > zero, max_y_ - s.y, s.y - min_y_) * (inverse * (ax * az));
    const Number to_face = hn::Max(zero, pick(s.kz > zero, max_z_ - s.z, s.z - min_z_)) * way_z;
    const Number to_wall = hn::Max(zero, hn::Min(to_x, to_y));
    const Number limit = s.depth * all(p_.per_absorption);
    Lanes absorbed = hn::And(active, limit <= to_wall);
    Number distance = hn::Min(limit, to_wall);
    const Number period = all(p_.height) * way_z;

    const Number more = hn::Floor((distance - to_face) * az * all(p_.per_height));
    Number faces = all(1.0) + hn::IfThenElseZero(face.total, more);
    faces = hn::IfThenElseZero(hn::And(active, to_face <= distance), faces);
    const Lanes met = p_.pattern_side >= 0 ? first_meeting(s, faces, to_face, period) : faces < zero;
    const Lanes at_face = hn::And(but_not(faces > zero, met), hn::Not(face.total));
    const Lanes stops = hn::Or(met, at_face);
    absorbed = but_not(absorbed, stops);
    faces = hn::IfThenZeroElse(at_face, faces);
    distance = pick(stops, to_face + faces * period, distance);
    s.count(active, faces + all(1.0));

    s.x = s.x + s.kx * distance;
    s.y = s.y + s.ky * distance;
    s.depth = s.depth - all(p_.absorption) * distance;
    reflect_totally(s, face, faces, distance - to_face, period, distance);
    s.z = pick(stops, pick(s.kz > zero, max_z_, min_z_), s.z);
    return {absorbed, met, at_face, but_not(but_not(active, stops), absorbed), to_x < to_y};
  }

  /// At bottom and top in turn; z up to where the light has come.
  HWY_INLINE void reflect_totally(State& s, const Face& face, Number faces, Number after_first, Number period,
                                  Number distance) const {
    const Lanes some = faces > all(0.0);
    const Number half = hn::Floor(all(0.5) * faces);
    const Lanes odd = faces != half + half;
    const Number from_last = pick(some, after_first - (faces - all(1.0)) * period, distance);
    s.kz = pick(odd, hn::Neg(s.kz), s.kz);
    const Number from = pick(some, pick(s.kz > all(0.0), min_z_, max_z_), s.z);
    s.z = hn::Min(hn::Max(from + s.kz * from_last, min_z_), max_z_);
    if (any(some)) s.light.reflect_totally(total_phase(face, n_), faces);
  }

  /// Faces met before the pattern is; lanes that meet it.
  HWY_INLINE Lanes first_meeting(State& s, Number& faces, Number to_face, Number period) const {
    const Lanes to_pattern = p_.pattern_side == 5 ? s.kz > all(0.0) : s.kz <= all(0.0);
    Number at = pick(to_pattern, all(0.0), all(1.0));
    const Number start = to_face + at * period;
    const Number twice = period + period;
    Number column = (s.x + s.kx * start - all(p_.x0)) * all(p_.per_x);
    Number row = (s.y + s.ky * start - all(p_.y0)) * all(p_.per_y);
    const Number columns = s.kx * twice * all(p_.per_x);
    const Number rows = s.ky * twice * all(p_.per_y);
    Lanes met = all(0.0) > all(1.0);
    Lanes going = at < faces;
    while (any(going)) {
      s.missed = pick(going, s.missed * horizontal_.open_at(column, row), s.missed);
      const Lanes now = hn::And(going, s.missed < s.fate);
      met = hn::Or(met, now);
      faces = pick(now, at, faces);
      at = at + all(2.0);
      column = column + columns;
      row = row + rows;
      going = but_not(hn::And(going, at < faces), now);
    }
    horizontal_.renew_fate(s, met);
    return met;
  }

  /// From inside.
  HWY_INLINE void meet_pattern(State& s, Lanes met, Number u, Number u1, Number u2) const {
    s.x = hn::Min(hn::Max(s.x, min_x_), max_x_);
    s.y = hn::Min(hn::Max(s.y, min_y_), max_y_);
    if (p_.dots.known == 0.0) return s.leave(met, LaneExit::kPattern);
    horizontal_.reflect_at(s, met, p_.dots, u, u1, u2);
  }

  /// Light from inside at bottom or top, which let it out.
  HWY_INLINE void meet_face(State& s, const Face& face, Lanes lanes, Number u) const {
    const Amplitudes amplitudes(face.c, face.root, n_);
    const Lanes reflected = hn::And(lanes, amplitudes.reflects(s.light, u));
    amplitudes.reflect(s.light, reflected);
    s.kz = pick(reflected, hn::Neg(s.kz), s.kz);
    const Lanes passed = but_not(lanes, reflected);
    if (!any(passed)) return;
    amplitudes.pass(s.light, passed);
    s.kx = pick(passed, s.kx * n_, s.kx);
    s.ky = pick(passed, s.ky * n_, s.ky);
    s.kz = pick(passed, hn::CopySignToAbs(face.root, s.kz), s.kz);
    s.x = pick(passed, hn::Min(hn::Max(s.x, min_x_), max_x_), s.x);
    s.y = pick(passed, hn::Min(hn::Max(s.y, min_y_), max_y_), s.y);
    const Lanes upward = s.kz > all(0.0);
    s.leave(hn::And(passed, upward), p_.open_above ? LaneExit::kEscaped : LaneExit::kTop);
    s.count(hn::And(passed, upward), all(p_.open_above ? 1.0 : 0.0));
    const Lanes below = but_not(passed, upward);
    if (!any(below)) return;
    if (p_.below.known == 0.0) return s.leave(below, LaneExit::kBottom);
    horizontal_.go_below(s, below);
  }

  const PlateConstants& p_;
  HorizontalStep horizontal_;
  Number min_x_, max_x_, min_y_, max_y_, min_z_, max_z_, n_;
};

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
