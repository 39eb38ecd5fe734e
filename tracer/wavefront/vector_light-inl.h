// Polarized light of many photons and smooth faces: `MeridianLight`, `WallTurn` and `PlateFresnel` of
// tracer/transport/planar_light.h, lane by lane. Included once for each instruction set.
#include "tracer/wavefront/vector_random-inl.h"

#if defined(EVENGLOW_VECTOR_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_VECTOR_LIGHT_INL_H
#undef EVENGLOW_VECTOR_LIGHT_INL_H
#else
#define EVENGLOW_VECTOR_LIGHT_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

/// U + iV times re + i im, or a turn by re = cos, im = sin.
struct Turn {
  Number re, im;
};

/// A Stokes vector; I is its unit.
struct Stokes {
  Number I, Q, U, V;

  HWY_INLINE void turn_phase(Lanes lanes, Turn t) {
    const Number u = U * t.re - V * t.im;
    V = pick(lanes, U * t.im + V * t.re, V);
    U = pick(lanes, u, U);
  }
  /// The frame's axes turned: cosine and sine of twice the angle.
  HWY_INLINE void turn_frame(Lanes lanes, Turn t) {
    const Number q = Q * t.re + U * t.im;
    U = pick(lanes, U * t.re - Q * t.im, U);
    Q = pick(lanes, q, Q);
  }
  HWY_INLINE void mirror(Lanes lanes) {
    U = pick(lanes, hn::Neg(U), U);
    V = pick(lanes, hn::Neg(V), V);
  }
  HWY_INLINE void forget(Lanes lanes) {
    I = pick(lanes, all(1.0), I);
    Q = hn::IfThenZeroElse(lanes, Q);
    U = hn::IfThenZeroElse(lanes, U);
    V = hn::IfThenZeroElse(lanes, V);
  }
  HWY_INLINE Number twice_power(Number p, Number s) const { return p * p * (I + Q) + s * s * (I - Q); }
  /// Amplitudes of p and s light times `p` and `s`.
  HWY_INLINE void scale(Lanes lanes, Number p, Number s) {
    const Number power_p = p * p * (I + Q);
    const Number power_s = s * s * (I - Q);
    const Number both = p * s;
    I = pick(lanes, all(0.5) * (power_p + power_s), I);
    Q = pick(lanes, all(0.5) * (power_p - power_s), Q);
    U = pick(lanes, U * both, U);
    V = pick(lanes, V * both, V);
  }
  /// Keeps the unit within the range of numbers.
  HWY_INLINE void rescale() {
    const Lanes far = hn::Or(I<all(1e-9), I> all(1e9));
    if (HWY_LIKELY(!any(far))) return;
    const Number inverse = all(1.0) / I;
    Q = pick(far, Q * inverse, Q);
    U = pick(far, U * inverse, U);
    V = pick(far, V * inverse, V);
    I = pick(far, all(1.0), I);
  }
  /// `count` total reflections (whole numbers, not negative), each of which turns U + iV by `phase`.
  HWY_INLINE void reflect_totally(Turn phase, Number count) {
    const Lanes polarized = hn::Or(U != all(0.0), V != all(0.0));
    count = hn::IfThenElseZero(polarized, count);
    Turn power{all(1.0), all(0.0)};
    while (any(count > all(0.0))) {
      const Number half = hn::Floor(all(0.5) * count);
      const Lanes odd = count != half + half;
      const Number re = power.re * phase.re - power.im * phase.im;
      power.im = pick(odd, power.re * phase.im + power.im * phase.re, power.im);
      power.re = pick(odd, re, power.re);
      const Number squared = phase.re * phase.re - phase.im * phase.im;
      phase.im = all(2.0) * phase.re * phase.im;
      phase.re = squared;
      count = half;
    }
    turn_phase(polarized, power);
  }
};

/// What depends on the angle of incidence at a face from index n into 1: the cosine c, and |sin^2 t - 1|^(1/2), which
/// is the cosine of the refracted ray, or its counterpart g in total reflection.
struct Face {
  Number c, root;
  Lanes total;

  HWY_INLINE Face(Number cosine, Number n) : c(cosine) {
    const Number excess = n * n * (all(1.0) - c * c) - all(1.0);
    total = excess >= all(0.0);
    root = hn::Sqrt(hn::Abs(excess));
  }
};

/// Phase of total reflection.
HWY_INLINE Turn total_phase(const Face& face, Number n) {
  const Number re = n * (face.c * face.c + face.root * face.root);
  const Number im = face.c * face.root * (all(1.0) - n * n);
  const Number inverse = all(1.0) / (re * re + im * im);
  return {(re * re - im * im) * inverse, all(2.0) * re * im * inverse};
}

/// Amplitudes where light gets through, with n = n1 / n2 (`PlateFresnel`).
struct Amplitudes {
  Number p_sum, s_sum, p_reflected, s_reflected;

  HWY_INLINE Amplitudes(Number c, Number t, Number n) {
    p_sum = c + n * t;
    s_sum = n * c + t;
    p_reflected = (c - n * t) * s_sum;
    s_reflected = (n * c - t) * p_sum;
  }
  HWY_INLINE Lanes reflects(const Stokes& light, Number u) const {
    const Number sums = p_sum * s_sum;
    return u * all(2.0) * light.I * sums * sums < light.twice_power(p_reflected, s_reflected);
  }
  HWY_INLINE void reflect(Stokes& light, Lanes lanes) const { light.scale(lanes, p_reflected, s_reflected); }
  HWY_INLINE void pass(Stokes& light, Lanes lanes) const { light.scale(lanes, s_sum, p_sum); }
};

/// Turn from the meridian frame to that of a wall (`WallTurn`); sign: +1 for x = const, -1 for y = const.
HWY_INLINE Turn wall_turn(Number kn, Number kt, Number kz, Number sign) {
  const Number c = kz * kn;
  const Number norm = c * c + kt * kt;
  const Lanes normal = norm < all(1e-14);
  const Number inverse = all(1.0) / pick(normal, all(1.0), norm);
  const Turn turn{(c * c - kt * kt) * inverse, all(-2.0) * sign * c * kt * inverse};
  return {pick(normal, all(1.0), turn.re), hn::IfThenZeroElse(normal, turn.im)};
}

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
