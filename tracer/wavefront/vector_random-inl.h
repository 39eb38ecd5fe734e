// Random numbers of many photons, and directions made of them. Included once for each instruction set.
#include <hwy/highway.h>

#include "tracer/wavefront/plate_lanes.h"

#if defined(EVENGLOW_VECTOR_RANDOM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_VECTOR_RANDOM_INL_H
#undef EVENGLOW_VECTOR_RANDOM_INL_H
#else
#define EVENGLOW_VECTOR_RANDOM_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kLanes>;
using WordTag = hn::RebindToUnsigned<Tag>;
using Number = hn::Vec<Tag>;  ///< one of each lane
using Word = hn::Vec<WordTag>;
using Lanes = hn::Mask<Tag>;  ///< some of the lanes

HWY_INLINE Number all(double value) {
  return hn::Set(Tag(), static_cast<float>(value));
}
HWY_INLINE Number pick(Lanes lanes, Number yes, Number no) {
  return hn::IfThenElse(lanes, yes, no);
}
HWY_INLINE bool any(Lanes lanes) {
  return !hn::AllFalse(Tag(), lanes);
}
/// a and not b.
HWY_INLINE Lanes but_not(Lanes a, Lanes b) {
  return hn::AndNot(b, a);
}

/// xoshiro128+ of each lane (Blackman & Vigna, ACM Trans. Math. Softw. 47, 2021), its state as `lane_words` draws it.
struct Random {
  Word s0, s1, s2, s3;

  /// Uniform in (0, 1), 23 bits: a number in [1, 2) from its bits, moved by half a unit of the last place.
  HWY_INLINE Number uniform() {
    const WordTag word;
    const Word bits = hn::Or(hn::ShiftRight<9>(next()), hn::Set(word, 0x3F800000U));
    return hn::BitCast(Tag(), bits) - all(1.0 - 0x1.0p-24);
  }
  /// Only these lanes use up a number.
  HWY_INLINE Number uniform(Lanes lanes) {
    const Random before = *this;
    const Number u = uniform();
    const auto words = hn::RebindMask(WordTag(), lanes);
    s0 = hn::IfThenElse(words, s0, before.s0);
    s1 = hn::IfThenElse(words, s1, before.s1);
    s2 = hn::IfThenElse(words, s2, before.s2);
    s3 = hn::IfThenElse(words, s3, before.s3);
    return u;
  }

 private:
  HWY_INLINE Word next() {
    const Word result = s0 + s3;
    const Word shifted = hn::ShiftLeft<9>(s1);
    s2 = hn::Xor(s2, s0);
    s3 = hn::Xor(s3, s1);
    s1 = hn::Xor(s1, s2);
    s0 = hn::Xor(s0, s3);
    s2 = hn::Xor(s2, shifted);
    s3 = hn::RotateRight<32 - 11>(s3);
    return result;
  }
};

/// Direction about +z.
struct Direction {
  Number x, y, z;
};

/// Density cos(theta) / pi; cosine and sine of the azimuth about the nearest quarter turn, as `core::TurnCosSin`.
HWY_INLINE Direction lambertian(Number u1, Number u2) {
  const Number quarter = hn::Floor(all(4.0) * u2 + all(0.5));
  const Number a = (u2 - all(0.25) * quarter) * all(6.283185307179586476925);
  const Number a2 = a * a;
  // Series to 4e-8, in pairs of terms that do not wait for each other.
  const Number a4 = a2 * a2;
  const Number c = (all(1.0) - all(0.5) * a2) + (all(1.0 / 24) - all(1.0 / 720) * a2 + all(1.0 / 40320) * a4) * a4;
  const Number s = a * ((all(1.0) - all(1.0 / 6) * a2) + (all(1.0 / 120) - all(1.0 / 5040) * a2) * a4);
  const Lanes odd = hn::Or(quarter == all(1.0), quarter == all(3.0));
  const Lanes left = hn::Or(quarter == all(1.0), quarter == all(2.0));
  const Lanes lower = hn::Or(quarter == all(2.0), quarter == all(3.0));
  const Number cosine = pick(odd, s, c);
  const Number sine = pick(odd, c, s);
  const Number sin_theta = hn::Sqrt(all(1.0) - u1);
  return {sin_theta * pick(left, hn::Neg(cosine), cosine), sin_theta * pick(lower, hn::Neg(sine), sine), hn::Sqrt(u1)};
}

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
