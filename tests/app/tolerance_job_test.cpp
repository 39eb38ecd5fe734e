#include "app/tolerance_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

namespace evenglow::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class ToleranceJobOf : public ::testing::Test {
 protected:
  ToleranceJob job(const std::string& variations, const std::string& set = "") {
    tests::write_text(folder_ / "tiny.yaml",
                      std::string(tests::kTinyRun) + "tolerance: {variations: " + variations + "}\n");
    Options options;
    options.files = {folder_ / "tiny.yaml"};
    if (!set.empty()) options.set = {set};
    return read_tolerance_job(options);
  }
  tests::TempFolder folder_;
};

TEST_F(ToleranceJobOf, KeysVaryAboutTheValueOfTheFileAsChanged) {
  const ToleranceJob a = job("[{kind: key, key: backlight.light_guide_plate.thickness_mm, uniform: 0.01}]",
                             "backlight.light_guide_plate.thickness_mm=0.8");
  EXPECT_EQ(a.values.values[0], 0.8);
  const ToleranceSample s = make_sample(a, 1);
  EXPECT_NEAR(s.run.backlight.plate->thickness, s.parameters[0], 1e-12);
  EXPECT_NEAR(s.parameters[0], 0.8, 0.01);
  EXPECT_NE(s.parameters[0], 0.8);
  EXPECT_NE(make_sample(a, 2).parameters[0], s.parameters[0]);
  EXPECT_EQ(make_sample(a, 1).parameters[0], s.parameters[0]);
}

TEST_F(ToleranceJobOf, LedsVaryAboutWhatTheFileSaysOfEach) {
  const ToleranceJob a = job("[{kind: led_flux, choices: [2]}, {kind: led_along_mm, uniform: 0}]",
                             "backlight.sources[0].flux_factors=[1, 3]");
  EXPECT_EQ(a.values.leds, std::vector<int>{2});
  const ToleranceSample s = make_sample(a, 1);
  EXPECT_NEAR(s.run.backlight.sources[0]->flux(), 9.0 * (2.0 + 6.0), 1e-9);
  EXPECT_THAT(s.run.overrides, Contains(HasSubstr("sources[0].flux_factors=[2, 6]")));
}

TEST_F(ToleranceJobOf, FilmsTurnByHalfATurnAtMost) {
  const ToleranceJob a = job("[{kind: film_angle_deg, film: 1, choices: [-1, -1]}]");
  EXPECT_THAT(make_sample(a, 1).run.overrides, Contains("backlight.films[1].axis_deg=179"));
}

TEST_F(ToleranceJobOf, DotsChangeTheDensityThatIsMade) {
  const ToleranceJob a = job("[{kind: dot_growth_um, choices: [6]}]");  // 60 um
  ASSERT_EQ(a.density.values.size(), 32U);
  const ToleranceSample s = make_sample(a, 1);
  for (const double value : s.run.backlight.microstructure->density_map)
    EXPECT_NEAR(value, a.density.values[0] * 1.21, 1e-12);
  EXPECT_EQ(a.nominal.backlight.microstructure->density_map, a.density.values);
}

}  // namespace
}  // namespace evenglow::app
