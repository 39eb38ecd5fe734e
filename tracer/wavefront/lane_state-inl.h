// The photons of a group in registers. Included once for each instruction set.
#include "tracer/wavefront/plate_lanes.h"
#include "tracer/wavefront/vector_light-inl.h"

#if defined(EVENGLOW_LANE_STATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef EVENGLOW_LANE_STATE_INL_H
#undef EVENGLOW_LANE_STATE_INL_H
#else
#define EVENGLOW_LANE_STATE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

/// The lanes of a group, or as many of them as a register takes, in registers.
struct State {
  Number x, y, z, kx, ky, kz;
  Stokes light;
  Number depth, missed, fate, events;
  Random random;
  Number exit;  ///< bits of LaneExit
  Number part, side;

  HWY_INLINE State(const PlateLanes& lanes, std::size_t i)
      : x(load(lanes.x, i)),
        y(load(lanes.y, i)),
        z(load(lanes.z, i)),
        kx(load(lanes.kx, i)),
        ky(load(lanes.ky, i)),
        kz(load(lanes.kz, i)),
        light{load(lanes.I, i), load(lanes.Q, i), load(lanes.U, i), load(lanes.V, i)},
        depth(load(lanes.depth, i)),
        missed(load(lanes.missed, i)),
        fate(load(lanes.fate, i)),
        events(load(lanes.events, i)),
        random{load(lanes.random[0], i), load(lanes.random[1], i), load(lanes.random[2], i), load(lanes.random[3], i)},
        exit(hn::BitCast(Tag(), load(lanes.exit, i))),
        part(load(lanes.part, i)),
        side(load(lanes.side, i)) {}

  /// The lanes `active`; the others stay what they were.
  HWY_INLINE void store(PlateLanes& lanes, std::size_t i, Lanes active) const {
    put(x, lanes.x, i, active);
    put(y, lanes.y, i, active);
    put(z, lanes.z, i, active);
    put(kx, lanes.kx, i, active);
    put(ky, lanes.ky, i, active);
    put(kz, lanes.kz, i, active);
    put(light.I, lanes.I, i, active);
    put(light.Q, lanes.Q, i, active);
    put(light.U, lanes.U, i, active);
    put(light.V, lanes.V, i, active);
    put(depth, lanes.depth, i, active);
    put(missed, lanes.missed, i, active);
    put(fate, lanes.fate, i, active);
    put(events, lanes.events, i, active);
    put(random.s0, lanes.random[0], i, active);
    put(random.s1, lanes.random[1], i, active);
    put(random.s2, lanes.random[2], i, active);
    put(random.s3, lanes.random[3], i, active);
    put(hn::BitCast(WordTag(), exit), lanes.exit, i, active);
    put(part, lanes.part, i, active);
    put(side, lanes.side, i, active);
  }

  HWY_INLINE void leave(Lanes lanes, LaneExit reason) {
    const Word word = hn::Set(WordTag(), static_cast<std::uint64_t>(reason));
    exit = pick(lanes, hn::BitCast(Tag(), word), exit);
  }
  HWY_INLINE void absorb(Lanes lanes, Number by) {
    leave(lanes, LaneExit::kAbsorbed);
    part = pick(lanes, by, part);
  }
  HWY_INLINE void count(Lanes lanes, Number number) { events = events + hn::IfThenElseZero(lanes, number); }
  HWY_INLINE void aim(Lanes lanes, Direction d, Number sign_z) {
    kx = pick(lanes, d.x, kx);
    ky = pick(lanes, d.y, ky);
    kz = pick(lanes, hn::CopySignToAbs(d.z, sign_z), kz);
  }

 private:
  static HWY_INLINE Number load(const LaneNumbers& from, std::size_t i) { return hn::Load(Tag(), from.data() + i); }
  static HWY_INLINE Word load(const LaneWords& from, std::size_t i) { return hn::Load(WordTag(), from.data() + i); }
  static HWY_INLINE void put(Number v, LaneNumbers& to, std::size_t i, Lanes active) {
    hn::BlendedStore(v, active, Tag(), to.data() + i);
  }
  static HWY_INLINE void put(Word v, LaneWords& to, std::size_t i, Lanes active) {
    hn::BlendedStore(v, hn::RebindMask(WordTag(), active), WordTag(), to.data() + i);
  }
};

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
