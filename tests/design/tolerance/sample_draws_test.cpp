#include "design/tolerance/sample_draws.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

Variation variation(VariationKind kind, const std::string& name, double spread) {
  Variation v;
  v.kind = kind;
  v.name = name;
  v.distribution.spread = spread;
  return v;
}

ToleranceSpec spec_of(std::vector<Variation> variations) {
  ToleranceSpec spec;
  spec.variations = std::move(variations);
  return spec;
}

TEST(SampleDraws, DependOnSeedVariationAndSampleAlone) {
  const Variation growth = variation(VariationKind::dot_growth, "dot_growth_um", 1.0);
  const Variation flux = variation(VariationKind::led_flux, "led_flux", 0.1);
  const Nominal one{{0.0}, {3, 0, 2}}, two{{0.0, 1.0}, {3, 0, 2}};
  const auto a = draw_sample(spec_of({growth}), one, 4), b = draw_sample(spec_of({growth, flux}), two, 4);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_THAT(b[1], SizeIs(5)) << "one for each LED of each row";
  EXPECT_NE(draw_sample(spec_of({growth}), one, 5)[0], a[0]);
  ToleranceSpec other = spec_of({growth});
  other.seed = 2;
  EXPECT_NE(draw_sample(other, one, 4)[0], a[0]);
}

TEST(SampleDraws, OfOneRowOnly) {
  Variation flux = variation(VariationKind::led_flux, "led_flux", 0.1);
  flux.source = 2;
  EXPECT_THAT(draw_sample(spec_of({flux}), {{1.0}, {3, 0, 2}}, 1)[0], SizeIs(2));
}

TEST(SampleDraws, ARelativeSpreadFollowsTheValue) {
  Variation key = variation(VariationKind::key, "key", 0.1);
  Variation relative = key;
  relative.relative = true;
  const double plain = draw_sample(spec_of({key}), {{-50.0}, {}}, 1)[0][0];
  const double scaled = draw_sample(spec_of({relative}), {{-50.0}, {}}, 1)[0][0];
  EXPECT_NEAR(scaled + 50.0, 50.0 * (plain + 50.0), 1e-9);
}

TEST(SampleDraws, ExtremesBringNeighborsTogether) {
  const ToleranceSpec spec = spec_of({variation(VariationKind::led_along, "led_along_mm", 0.1),
                                      variation(VariationKind::led_height, "led_height_mm", 0.2)});
  const Nominal nominal{{0.0, 0.0}, {3}};
  const auto least = extreme_sample(spec, nominal, false), greatest = extreme_sample(spec, nominal, true);
  EXPECT_NEAR(least[0][0], -0.3, 1e-12);
  EXPECT_NEAR(least[0][1], 0.3, 1e-12);
  EXPECT_NEAR(greatest[0][0], 0.3, 1e-12);
  EXPECT_NEAR(greatest[0][1], -0.3, 1e-12);
  EXPECT_THAT(greatest[1], testing::Each(testing::DoubleNear(0.6, 1e-12)));
}

TEST(SampleDraws, ParametersTellListsByMeanAndSpread) {
  Variation region = variation(VariationKind::dot_region, "dot_region_um", 2.0);
  region.length = 3.0;
  const ToleranceSpec spec = spec_of({variation(VariationKind::led_flux, "led_flux", 0.1), region,
                                      variation(VariationKind::dot_size, "dot_size_um", 1.0),
                                      variation(VariationKind::dot_growth, "dot_growth_um", 1.0)});
  EXPECT_THAT(parameter_names(spec), ElementsAre("led_flux, mean", "led_flux, spread", "dot_region_um, mean",
                                                 "dot_region_um, spread", "dot_growth_um"));
  core::CellField growth(core::CellGrid::over(2, 1, 0, 0, 2, 1), 0.0);
  growth.values = {0.001, 0.003};  // mm
  const auto p = parameters_of(spec, {{0.9, 1.1}, {}, {}, {0.5}}, {{}, growth, {}, {}});
  ASSERT_THAT(p, SizeIs(5));
  const std::vector<double> expected = {1.0, 0.1, 2.0, 1.0, 0.5};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(p[i], expected[i], 1e-12) << i;
}

TEST(SampleDraws, DotsGrowTogetherAndByRegion) {
  Variation region = variation(VariationKind::dot_region, "dot_region_um", 2.0);
  region.length = 5.0;
  const ToleranceSpec spec = spec_of({variation(VariationKind::dot_growth, "dot_growth_um", 1.0), region});
  const core::CellField density(core::CellGrid::over(20, 10, 0, 0, 20, 10), 0.1);
  const DotModel model = dot_model(density, 1.0, {});  // 60 um
  const SampleDots dots = draw_dots(spec, {{3.0}, {}}, 1, density, model);
  ASSERT_TRUE(varies_dots(spec));
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    const double diameter = 0.06 + 0.003 + dots.growth[1].values[i];
    EXPECT_NEAR(dots.density.values[i], 0.1 * diameter * diameter / 0.0036, 1e-12);
  }
  EXPECT_NE(dots.growth[1].min(), dots.growth[1].max());
  EXPECT_EQ(draw_dots(spec, {{3.0}, {}}, 1, density, model).density.values, dots.density.values);
  EXPECT_NE(draw_dots(spec, {{3.0}, {}}, 2, density, model).density.values, dots.density.values);
  EXPECT_FALSE(varies_dots(spec_of({variation(VariationKind::led_flux, "led_flux", 0.1)})));
}

}  // namespace
}  // namespace evenglow::design
