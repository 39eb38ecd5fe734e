#include "tracer/microstructure/bump_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/bumps.h"

namespace evenglow::tests {
namespace {

using testing::HasSubstr;

TEST(BumpKeys, ShapesAreAccepted) {
  for (const std::string keys : {"kind: microlens", "kind: cone", "kind: pyramid", "kind: v_groove"}) {
    for (const std::string form : {"", ", form: raised", ", form: sunk"}) {
      const tracer::Microstructure shape = shape_of(keys + form);
      EXPECT_THAT(keys, HasSubstr(shape.kind));
      const auto optics = shape.optics(1.5);
      EXPECT_TRUE(optics->redirects());
      EXPECT_FALSE(optics->scatters());
      const core::Vec3 up = core::Vec3::UnitZ();
      EXPECT_EQ(optics->evaluate(core::StokesVector::unpolarized(1.0, {}), up).I, 0.0);
      EXPECT_EQ(optics->specular(up).transmission.norm() + optics->specular(up).reflection.norm(), 0.0);
    }
  }
}

TEST(BumpKeys, AspectOrFlank) {
  const auto flank = [](const std::string& keys) {
    const core::ConfigDocument document = core::ConfigDocument::parse(keys, "run.yaml");
    const tracer::Flank read = tracer::read_flank(document.root());
    document.finish();
    return read;
  };
  EXPECT_NEAR(flank("{}").angle, 45.0 * core::kRadPerDeg, 1e-15);
  EXPECT_EQ(flank("{}").truncation, 0.0);
  EXPECT_NEAR(flank("flank_deg: 30").angle, 30.0 * core::kRadPerDeg, 1e-15);
  EXPECT_NEAR(flank("aspect: 0.5").angle, 45.0 * core::kRadPerDeg, 1e-15);
  // Half the width is cut off: the same height on half the way.
  EXPECT_NEAR(flank("{aspect: 0.25, truncation: 0.5}").angle, 45.0 * core::kRadPerDeg, 1e-15);
}

TEST(BumpKeys, FillIsTold) {
  EXPECT_EQ(shape_of("kind: pyramid").fill, 1.0);
  EXPECT_EQ(shape_of("kind: pyramid, fill: 0.9").fill, 0.9);
  EXPECT_EQ(shape_of("kind: microlens, fill: 0.3").fill, 0.3);
}

TEST(BumpKeys, Faults) {
  EXPECT_THAT(faults_of_shape("kind: cone, flank_deg: 45, aspect: 1"),
              HasSubstr("run.yaml:1:53: microstructure.aspect: must be left out where flank_deg is given, got both"));
  EXPECT_THAT(faults_of_shape("kind: pyramid, aspect: 8"),
              HasSubstr("must not make flanks steeper than 85 deg, got 86.4237 deg with the truncation 0"));
  EXPECT_THAT(faults_of_shape("kind: pyramid, form: flat"), HasSubstr("must be one of raised, sunk; got flat"));
  EXPECT_THAT(faults_of_shape("kind: cone, flank_deg: 90"), HasSubstr("must lie in [0.1, 85], got 90"));
  EXPECT_THAT(faults_of_shape("kind: cone, truncation: 1"), HasSubstr("must lie in [0, 0.95], got 1"));
  EXPECT_THAT(faults_of_shape("kind: cone, axis_deg: 10"), HasSubstr("unknown key"));
  EXPECT_THAT(faults_of_shape("kind: microlens, aspect: 0.6"), HasSubstr("must lie in [0.0001, 0.5], got 0.6"));
  EXPECT_THAT(faults_of_shape("kind: v_groove, flanks_deg: [45]"), HasSubstr("must hold 2 numbers, got 1"));
  EXPECT_THAT(faults_of_shape("kind: v_groove, flanks_deg: [45, 95]"), HasSubstr("must lie in [0.1, 85], got 95"));
  EXPECT_THAT(faults_of_shape("kind: cone, fill: 0.9"),
              HasSubstr("microstructure.fill: must lie in [0.01, 0.785] or be 1 for a round footprint, got 0.9"));
  EXPECT_THAT(faults_of_shape("kind: microlens, fill: 0"), HasSubstr("must lie in [0.01, 1], got 0"));
  EXPECT_THAT(faults_of_shape("kind: v_groove, axis_deg: 180"), HasSubstr("must lie in [0, 180), got 180"));
}

}  // namespace
}  // namespace evenglow::tests
