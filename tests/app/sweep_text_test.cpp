#include "app/sweep_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::app {
namespace {

using testing::HasSubstr;
using testing::Not;

tracer::SweepRow row() {
  tracer::SweepRow r;
  r.sigma = 35 * core::kRadPerDeg;
  r.azimuth = 20 * core::kRadPerDeg;
  r.light = tracer::SweepLight::diagonal;
  r.reflectance = r.specular_reflectance = {0.125, 0.0};
  r.transmittance = {0.75, 0.0};
  r.specular_transmittance = {0.25, 0.0};
  r.scattered_transmittance = {0.5, 0.0};
  r.absorbed = {0.125, 0.0};
  r.transmitted = {1.0, 0.6, 1e-17, -0.8};
  return r;
}

TEST(SweepText, CsvHoldsEveryNumber) {
  const std::string text = sweep_csv({row()}, "lpp film of a.yaml", true);
  EXPECT_THAT(text, HasSubstr("# lpp film of a.yaml, lit from above: angles in degrees"));
  EXPECT_THAT(text, HasSubstr("\n550,20,45,35,0.125,0,0.75,0,0.125,0,0.125,0,0.25,0,0,0,0.5,0,1,0.6,0,-0.8,,,,\n"));
  auto dark = row();
  dark.transmitted.reset();
  EXPECT_THAT(sweep_csv({dark}, "x", false), HasSubstr(",0.5,0,,,,,,,,\n"));
}

TEST(SweepText, TheTableTellsExactFromCounted) {
  EXPECT_THAT(sweep_table({row()}),
              AllOf(HasSubstr("exact"), HasSubstr("0.7500"), HasSubstr("-0.8000"), Not(HasSubstr("±"))));
  auto counted = row();
  counted.transmittance.se = 0.0123;
  EXPECT_THAT(sweep_table({counted}), AllOf(HasSubstr("0.7500 ±0.0123"), Not(HasSubstr("exact"))));
}

TEST(SweepText, TellsTheFacetsOfPrisms) {
  auto few = row(), many = row();
  few.facets = core::Estimate{1.5, 0.01};
  many.facets = core::Estimate{2.25, 0.02};
  EXPECT_THAT(sweep_table({few, many}), HasSubstr("on average: 1.500 ±0.010 to 2.250 ±0.020"));
  EXPECT_THAT(sweep_table({row()}), Not(HasSubstr("facets")));
  EXPECT_THAT(sweep_csv({few}, "x", false), HasSubstr("-0.8,,,1.5,0.01\n"));
}

TEST(SweepText, TheTableEndsAt60Rows) {
  EXPECT_THAT(sweep_table(std::vector<tracer::SweepRow>(60, row())), Not(HasSubstr("rows more")));
  EXPECT_THAT(sweep_table(std::vector<tracer::SweepRow>(61, row())), HasSubstr("1 rows more"));
}

}  // namespace
}  // namespace evenglow::app
