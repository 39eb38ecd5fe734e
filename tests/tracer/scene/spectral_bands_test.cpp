#include "tracer/scene/spectral_bands.h"

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"

namespace evenglow::tracer {
namespace {

Spectrum flat() {
  Spectrum s;
  for (double nm = 380.0; nm <= 780.0; nm += 1.0) {
    s.wavelength.push_back(nm);
    s.power.push_back(1.0);
  }
  return s;
}

/// Mean weight over evenly spaced uniform numbers.
core::Vec3 mean_weight(const SpectralBands& bands, std::size_t source) {
  constexpr int kSteps = 1 << 20;
  core::Vec3 sum = core::Vec3::Zero();
  for (int i = 0; i < kSteps; ++i) sum += bands.choose(source, (i + 0.5) / kSteps).weight;
  return sum / kSteps;
}

TEST(SpectralBands, OneLineIsOneBandOfUnitWeight) {
  const SpectralBands bands({monochromatic(450.0)}, {9.0}, 24, false);
  ASSERT_EQ(bands.size(), 1U);
  EXPECT_EQ(bands.wavelength(0), 450.0);
  EXPECT_EQ(bands.choose(0, 0.7).weight.y(), 1.0);
}

TEST(SpectralBands, FewLinesKeepTheirWavelengths) {
  const SpectralBands bands({{{450.0, 555.0, 630.0}, {5.0, 1.0, 2.0}}}, {1.0}, 24, true);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands.wavelength(0), 450.0);
  EXPECT_EQ(bands.wavelength(1), 555.0);
  EXPECT_EQ(bands.wavelength(2), 630.0);
}

TEST(SpectralBands, ByLuminanceEveryPhotonCarriesTheSame) {
  const SpectralBands bands({flat()}, {1.0}, 16, false);
  EXPECT_GE(bands.size(), 12U);
  EXPECT_LE(bands.size(), 16U);
  for (double u = 0.001; u < 1.0; u += 0.01) EXPECT_NEAR(bands.choose(0, u).weight.y(), 1.0, 1e-12);
}

TEST(SpectralBands, TheMeanIsTheColorOfTheSource) {
  for (const bool color : {false, true}) {
    const SpectralBands bands({flat()}, {1.0}, 16, color);
    const core::Vec3 mean = mean_weight(bands, 0);
    const core::Vec3 expected = flat().xyz() / flat().xyz().y();
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], expected[c], 2e-5) << color;
      EXPECT_NEAR(bands.mean_weight()[c], expected[c], 1e-12) << color;
    }
  }
}

TEST(SpectralBands, ColorLightensTheBluePhotons) {
  const SpectralBands by_luminance({flat()}, {1.0}, 16, false), by_color({flat()}, {1.0}, 16, true);
  double heaviest[2] = {0.0, 0.0};
  for (double u = 0.0005; u < 1.0; u += 0.001) {
    heaviest[0] = std::max(heaviest[0], by_luminance.choose(0, u).weight.z());
    heaviest[1] = std::max(heaviest[1], by_color.choose(0, u).weight.z());
  }
  EXPECT_LT(heaviest[1], 0.5 * heaviest[0]);
}

TEST(SpectralBands, SourcesShareBandsByTheirFlux) {
  const SpectralBands bands({monochromatic(450.0), monochromatic(650.0)}, {1.0, 3.0}, 24, true);
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands.choose(0, 0.9).band, 0U);
  EXPECT_EQ(bands.choose(1, 0.1).band, 1U);
  const core::Vec3 blue = core::color_matching(450.0) / core::color_matching(450.0).y();
  const core::Vec3 red = core::color_matching(650.0) / core::color_matching(650.0).y();
  const core::Vec3 expected = 0.25 * blue + 0.75 * red;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(bands.mean_weight()[c], expected[c], 1e-12);
}

TEST(SpectralBands, NothingIsOneBand) {
  const SpectralBands bands({}, {}, 24, true);
  ASSERT_EQ(bands.size(), 1U);
  EXPECT_EQ(bands.wavelength(0), 550.0);
}

}  // namespace
}  // namespace evenglow::tracer
