#include "design/report/map_relations.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

Report with(const char* name, double luminance, double se, double lumen) {
  Report r = samples::report(name);
  r.luminance = {{3, 2, 0, 0, 1, 1}, luminance};
  r.luminance_se = {{3, 2, 0, 0, 1, 1}, se};
  r.energy.emitted_lm = lumen;
  return r;
}

TEST(MapRelations, AreForEqualFluxWithErrorsOfBoth) {
  const Report base = with("lpp", 1000.0, 30.0, 50.0);
  const Report other = with("dbef", 3000.0, 120.0, 100.0);
  const auto ratio = luminance_ratio(other, base);
  ASSERT_TRUE(ratio.has_value());
  EXPECT_EQ(ratio->name, "dbef / lpp");
  EXPECT_NEAR(ratio->field.values[4], 1.5, 1e-12);
  EXPECT_NEAR(ratio->se.values[4], 1.5 * std::hypot(0.04, 0.03), 1e-12);
  const auto difference = luminance_difference(other, base);
  EXPECT_NEAR(difference->field.values[4], 500.0, 1e-9);
  EXPECT_NEAR(difference->se.values[4], std::hypot(60.0, 30.0), 1e-9);
}

TEST(MapRelations, OfADarkBaseHaveNoValue) {
  const auto ratio = luminance_ratio(with("a", 5.0, 1.0, 1.0), with("b", 0.0, 0.0, 1.0));
  EXPECT_TRUE(std::isnan(ratio->field.values[0]));
}

TEST(MapRelations, NeedTheSameCells) {
  Report other = samples::report("b");
  other.luminance = samples::ramp(5, 4, 1.0);
  other.density = samples::ramp(5, 4, 0.1);
  EXPECT_FALSE(luminance_ratio(other, samples::report("a")));
  EXPECT_FALSE(luminance_difference(other, samples::report("a")));
  EXPECT_FALSE(density_difference(other, samples::report("a")));
  EXPECT_FALSE(luminance_ratio(Report{}, Report{}));
}

TEST(MapRelations, DensityHasNoErrors) {
  Report other = samples::report("b");
  for (double& value : other.density.values) value += 0.25;
  const auto difference = density_difference(other, samples::report("a"));
  EXPECT_NEAR(difference->field.values[7], 0.25, 1e-12);
  EXPECT_TRUE(difference->se.values.empty());
}

}  // namespace
}  // namespace evenglow::design
