#include "design/report/report.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

Report judged(const std::string& name, double emitted_lm, core::Estimate luminance, core::Estimate efficiency) {
  Report r = samples::report(name);
  r.energy.emitted_lm = emitted_lm;
  r.final.luminance_mean = luminance;
  r.final.efficiency = efficiency;
  return r;
}

TEST(CompareReports, RatiosAreForEqualLedFlux) {
  // By hand: (1500 / 50) / (1000 / 100) = 3; relative errors 3 % and 4 % make 5 % of 3 = 0.15.
  // Efficiency and flux for equal LED flux: 0.6 / 0.4 = 1.5; relative errors 1.2 % and 0.5 % make 1.3 % of 1.5 =
  // 0.0195.
  const Comparison c = compare_reports(
      "t", "c",
      {judged("lpp", 100.0, {1000.0, 40.0}, {0.4, 0.002}), judged("dbef", 50.0, {1500.0, 45.0}, {0.6, 0.0072})});
  ASSERT_EQ(c.ratios.size(), 1U);
  EXPECT_EQ(c.ratios[0].name, "dbef/lpp");
  EXPECT_NEAR(c.ratios[0].luminance.value, 3.0, 1e-12);
  EXPECT_NEAR(c.ratios[0].luminance.se, 0.15, 1e-12);
  EXPECT_NEAR(c.ratios[0].flux.value, 1.5, 1e-12);
  EXPECT_NEAR(c.ratios[0].flux.se, 0.0195, 1e-12);
  EXPECT_NEAR(c.ratios[0].efficiency.value, 1.5, 1e-12);
  EXPECT_NEAR(c.ratios[0].efficiency.se, 0.0195, 1e-12);
}

TEST(CompareReports, FirstVariantIsTheBaseOfAll) {
  const Comparison c = compare_reports("t", "c", {samples::report("a"), samples::report("b"), samples::report("c")});
  ASSERT_EQ(c.ratios.size(), 2U);
  EXPECT_EQ(c.ratios[0].name, "b/a");
  EXPECT_EQ(c.ratios[1].name, "c/a");
}

TEST(CompareReports, NamesAreNeverEmptyNorTwiceTheSame) {
  const Comparison c = compare_reports("t", "c", {samples::report("a"), samples::report("a"), samples::report("")});
  EXPECT_EQ(c.variants[1].variant, "a-2");
  EXPECT_EQ(c.variants[2].variant, "variant");
}

TEST(CompareReports, DarkVariantHasAnErrorAndDarkBaseHasNoRatio) {
  const Report dark = judged("dark", 100.0, {0.0, 10.0}, {0.0, 0.001});
  const Report lit = judged("lit", 100.0, {1000.0, 10.0}, {0.5, 0.001});
  const Comparison c = compare_reports("t", "c", {lit, dark});
  EXPECT_EQ(c.ratios[0].luminance.value, 0.0);
  EXPECT_NEAR(c.ratios[0].luminance.se, 0.01, 1e-12);
  EXPECT_FALSE(std::isfinite(compare_reports("t", "c", {dark, lit}).ratios[0].luminance.value));
}

TEST(CompareReports, NeedsAVariant) {
  EXPECT_THROW(compare_reports("t", "c", {}), core::Error);
}

}  // namespace
}  // namespace evenglow::design
