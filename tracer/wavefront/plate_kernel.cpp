#include "tracer/wavefront/plate_kernel.h"

// Compiled once for each instruction set. Those that this program has no use for: without registers of two doubles, or
// of lengths that are known only at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracer/wavefront/plate_kernel.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
// Before the code below, which is compiled for each.
#include <hwy/highway.h>

#include "tracer/wavefront/plate_step-inl.h"

HWY_BEFORE_NAMESPACE();
namespace evenglow::tracer::HWY_NAMESPACE {

void step_groups(const PlateConstants& plate, PlateLanes* groups, std::size_t count) {
  const Stepper stepper(plate);
  for (std::size_t group = 0; group < count; ++group) {
    PlateLanes& lanes = groups[group];
    for (std::size_t i = 0; i < kLanes; i += hn::Lanes(Tag())) {
      State state(lanes, i);
      const auto idle = hn::BitCast(WordTag(), state.exit) != hn::Zero(WordTag());
      const Lanes active = hn::Not(hn::RebindMask(Tag(), idle));
      if (!any(active)) continue;
      stepper.step(state, active);
      state.store(lanes, i, active);
    }
  }
}

void enter_group(const PlateConstants& plate, PlateLanes& group) {
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(Tag())) {
    State state(group, i);
    const Word arrives = hn::Set(WordTag(), static_cast<std::uint64_t>(LaneExit::kArrives));
    const Lanes active = hn::RebindMask(Tag(), hn::BitCast(WordTag(), state.exit) == arrives);
    if (!any(active)) continue;
    state.leave(active, LaneExit::kNone);
    state.light.forget(active);
    WallStep(plate, state, active, state.side < all(2.0)).meet_from_outside();
    state.store(group, i, active);
  }
}

}  // namespace evenglow::tracer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace evenglow::tracer {

HWY_EXPORT(step_groups);
HWY_EXPORT(enter_group);

void step_plate(const PlateConstants& plate, PlateLanes* groups, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(step_groups)(plate, groups, count);
}

void enter_plate(const PlateConstants& plate, PlateLanes& group) {
  HWY_DYNAMIC_DISPATCH(enter_group)(plate, group);
}

std::vector<std::int64_t> instruction_sets() {
  return hwy::SupportedAndGeneratedTargets();
}

std::string instruction_set_name(std::int64_t set) {
  return hwy::TargetName(set);
}

void force_instruction_set(std::int64_t set) {
  hwy::SetSupportedTargetsForTest(set);
}

}  // namespace evenglow::tracer
#endif
