#include "tracer/transport/viewer_levels.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1}, ";
const std::string kLeds = "sources: [{kind: led_row, count: 2}]";
const std::string kDots = ", microstructure: {cells: [2, 2]}";
const std::string kBottom = ", reflectors: {bottom: {gap_mm: 0.2}, right: {gap_mm: 0.3}}";

int primaries(const ViewerLevels& levels) {
  int count = 0;
  for (const ViewerLevel& level : levels.all()) count += level.primary ? 1 : 0;
  return count;
}

TEST(ViewerLevels, AreAllHorizontalBordersFromBelow) {
  const Scene scene = scene_of(kPlate + kLeds + kDots + kBottom +
                               ", films: [{kind: diffuser, gap_mm: 0.1}, {kind: sheet, gap_mm: 0.05, thickness_mm: "
                               "0.4}, {kind: lpp, gap_mm: 0.01}]");
  const ViewerLevels levels(scene);
  ASSERT_EQ(levels.all().size(), 7U);
  const double heights[] = {-0.2, 0.0, 1.0, 1.1, 1.15, 1.55, 1.56};
  const int body_above[] = {-1, 0, -1, -1, 1, -1, -1};
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR(levels[i].z, heights[i], 1e-12);
    EXPECT_EQ(levels[i].body_above, body_above[i]) << i;
    EXPECT_EQ(levels.of_quad(levels[i].quad), i);
    EXPECT_EQ(levels[i].outer, i != 1 && i != 2) << i;  // the films reach over the gap at the right
  }
  EXPECT_TRUE(levels[1].patterned);
  EXPECT_FALSE(levels[2].patterned);
  for (const int recorded : {0, 1, 3}) EXPECT_TRUE(levels[recorded].recorded) << recorded;
  for (const int clear : {2, 4, 5, 6}) EXPECT_FALSE(levels[clear].recorded) << clear;
  EXPECT_TRUE(levels[3].holds({20.2, 5, 0}));
  EXPECT_FALSE(levels[2].holds({20.2, 5, 0}));
}

/// Where estimates are always made: at white dots and below; else at the lowest film that scatters; else at the bottom.
TEST(ViewerLevels, PrimaryIsWhatPays) {
  const std::string films = ", films: [{kind: diffuser}, {kind: diffuser}]";
  const Scene dotted = scene_of(kPlate + kLeds + kDots + kBottom + films);
  const ViewerLevels dots(dotted);
  EXPECT_TRUE(dots[0].primary && dots[1].primary);
  EXPECT_EQ(primaries(dots), 2);
  const Scene lensed =
      scene_of(kPlate + kLeds + kBottom + films + ", microstructure: {cells: [2, 2], kind: microlens}");
  const ViewerLevels lenses(lensed);
  EXPECT_TRUE(lenses[3].primary);
  EXPECT_EQ(primaries(lenses), 1);
  const Scene bare = scene_of(kPlate + kLeds + kBottom + ", microstructure: {cells: [2, 2], kind: microlens}");
  const ViewerLevels bottom(bare);
  EXPECT_TRUE(bottom[0].primary);
  EXPECT_EQ(primaries(bottom), 1);
}

/// A lobe narrower than the cone is not estimated; beneath a lobe twice as wide as the cone, one narrower than that.
TEST(ViewerLevels, LeaveNarrowLobes) {
  const auto joined = [](const std::string& films, const std::string& receiver) {
    const Scene scene = scene_of(kPlate + kLeds + ", reflectors: {bottom: {kind: mirror}}, films: [" + films +
                                 "], receivers: [{kind: luminance, " + receiver + "}]");
    const ViewerLevels levels(scene);
    std::string found;
    for (const ViewerLevel& level : levels.all()) {
      if (level.z > 1.0) found += level.joined && level.recorded ? (level.primary ? 'p' : 'j') : '-';
    }
    return found;
  };
  const auto diffuser = [](int width) {
    return "{kind: diffuser, gap_mm: 0.1, fwhm_deg: " + std::to_string(width) + "}";
  };
  EXPECT_EQ(joined(diffuser(8) + ", " + diffuser(20), "cone_deg: 10"), "-p");
  EXPECT_EQ(joined(diffuser(20) + ", " + diffuser(8), "cone_deg: 10"), "p-");
  EXPECT_EQ(joined(diffuser(15) + ", " + diffuser(60), "cone_deg: 10"), "-p");
  EXPECT_EQ(joined(diffuser(15) + ", " + diffuser(15), "cone_deg: 10"), "pj");
  EXPECT_EQ(joined(diffuser(60) + ", " + diffuser(15), "cone_deg: 10"), "pj");
  EXPECT_EQ(joined(diffuser(8) + ", " + diffuser(20), "cone_deg: 0"), "pj");
  EXPECT_EQ(joined(diffuser(8) + ", " + diffuser(20), "estimator: next_event"), "pj");
}

/// The tilted bottom of a wedge and all below it are no levels.
TEST(ViewerLevels, EndAtAWedge) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1, end_thickness_mm: 0.6}, " + kLeds + kBottom);
  const ViewerLevels levels(scene);
  ASSERT_EQ(levels.all().size(), 1U);
  EXPECT_EQ(levels[0].z, 1.0);
}

/// LEDs stand between the side wall and the plate: films and the bottom end before them.
TEST(ViewerLevels, LeaveRoomForFreeSources) {
  const Scene scene = scene_of(kPlate + "sources: [{kind: led_row, edge: left, count: 2, gap_mm: 0.05}]" +
                               ", reflectors: {bottom: {}, left: {gap_mm: 0.2}}, films: [{kind: diffuser}]");
  const ViewerLevels levels(scene);
  EXPECT_NEAR(scene.box.min.x(), -0.2, 1e-12);
  for (const ViewerLevel& level : levels.all()) EXPECT_NEAR(level.min_x, level.outer ? -0.05 : 0.0, 1e-12);
}

}  // namespace
}  // namespace evenglow::tests
