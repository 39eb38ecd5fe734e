#include "design/dots/moire.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "design/dots/dot_index.h"
#include "design/dots/placement.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

std::vector<Beat> beats_of(const core::DotPattern& dots, const std::vector<Grating>& gratings) {
  const FreeArea free = whole_plate();
  return find_beats(index_dots(dots, free.bounds(), 2), free, gratings, {}, 2);
}

Grating panel(double pitch, double angle = 0.0) {
  return {"panel", {pitch, pitch, angle}, true};
}

TEST(Moire, LatticeNearThePanelsPitchBeats) {
  const auto beats = beats_of(lattice_pattern(0.1), {panel(0.104)});
  ASSERT_FALSE(beats.empty());
  EXPECT_TRUE(beats[0].visible);
  // 1 / (1 / 0.1 - 1 / 0.104) = 2.6 mm; the spectrum is looked at in steps of 1 / 16 mm.
  EXPECT_NEAR(1.0 / beats[0].period, 1.0 / 2.6, 0.05);
  EXPECT_NEAR(beats[0].pattern_period, 0.1, 1e-3);
  EXPECT_EQ(beats[0].grating, "panel");
}

TEST(Moire, TurnedLatticeBeatsByItsAngle) {
  // Equal pitches at an angle a: 0.1 / (2 sin(a / 2)).
  const double angle = 3.0 * core::kRadPerDeg;
  const auto beats = beats_of(lattice_pattern(0.1), {panel(0.1, angle)});
  ASSERT_FALSE(beats.empty());
  EXPECT_NEAR(1.0 / beats[0].period, 2.0 * std::sin(0.5 * angle) / 0.1, 0.07);
  EXPECT_TRUE(beats[0].visible);
}

TEST(Moire, FarPitchesDoNotBeat) {
  for (const Beat& beat : beats_of(lattice_pattern(0.1), {panel(0.0615)})) EXPECT_FALSE(beat.visible) << beat.period;
}

TEST(Moire, PrismLinesBeatAcrossTheirGroovesOnly) {
  const Grating across_x{"films[0] (bef)", {0.051, 0.0, 0.0}, false};
  const auto beats = beats_of(lattice_pattern(0.1, 0.02f), {across_x});  // order 2 of the lattice: 0.05
  ASSERT_FALSE(beats.empty());
  EXPECT_NEAR(1.0 / beats[0].period, 1.0 / 0.05 - 1.0 / 0.051, 0.07);
  EXPECT_EQ(beats[0].order_y, 0);
}

TEST(Moire, BlueNoiseDoesNotBeat) {
  const CoverageMap map(core::CellField(graded_coverage().grid, 0.2), whole_plate());
  DotSpec spec;
  spec.diameter = 0.05;
  const core::DotPattern dots = place_dots(spec, map, 2).dots;
  const double pitch = 1.0 / std::sqrt(0.2 / core::footprint_area(spec.footprint, spec.diameter));
  for (const double near : {0.95, 1.02})
    EXPECT_TRUE(beats_of(dots, {panel(near * pitch), {"bef", {0.05, 0.0, 0.1}, false}}).empty()) << near;
}

TEST(Moire, TheEyeSeesBestNearEightCycles) {
  EXPECT_NEAR(eye_sensitivity(8.0), 1.0, 0.01);
  EXPECT_LT(eye_sensitivity(40.0), 0.1);
  EXPECT_LT(eye_sensitivity(0.5), 0.3);
}

}  // namespace
}  // namespace evenglow::tests
