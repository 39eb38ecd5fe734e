#include "tracer/sources/led_tolerances.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using ::testing::HasSubstr;

BacklightSpec row(const std::string& keys) {
  return backlight_of(
      "light_guide_plate: {length_mm: 20, width_mm: 30, thickness_mm: 0.6}, sources: [{kind: led_row, count: 5, "
      "pitch_mm: 5, size_mm: [2, 0.4], " +
      keys + "}]");
}

std::string fault(const std::string& keys) {
  try {
    row(keys);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "none";
}

std::vector<double> counts_of(const Source& source, int photons) {
  std::vector<double> counts(source.windows().size(), 0.0);
  core::PhotonRng rng({20260108, 0, 0}, 0);
  for (int i = 0; i < photons; ++i) counts[static_cast<std::size_t>(source.emit(rng).quad)] += 1.0;
  return counts;
}

/// Mean, standard deviation and cut of many draws against those of the cut normal: variance 1 - 2 c phi(c) / (2 Phi(c)
/// - 1) with c = 3.
TEST(LedTolerances, SpreadsAreCutNormal) {
  LedToleranceKeys keys;
  keys.flux_spread = 0.1;
  keys.position_spread = 0.2;
  constexpr int kCount = 20000;
  const LedTolerances drawn = draw_tolerances(keys, kCount, 10.0);
  const double c = kToleranceCut;
  const double density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::acos(-1.0));
  const double variance = 1.0 - 2.0 * c * density / std::erf(c / std::sqrt(2.0));
  const auto check = [&](const std::vector<double>& values, double mean, double sigma) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double v : values) {
      ASSERT_LE(std::abs(v - mean), c * sigma * (1 + 1e-12));
      sum += (v - mean) / sigma;
      squares += (v - mean) * (v - mean) / (sigma * sigma);
    }
    EXPECT_LT(std::abs(sum / kCount) / std::sqrt(variance / kCount), z_limit(1e-3, 4));
    EXPECT_LT(std::abs(squares / kCount - variance) / std::sqrt(2.0 / kCount), z_limit(1e-3, 4));
  };
  check(drawn.fluxes, 10.0, 1.0);
  check(drawn.offsets, 0.0, 0.2);
}

TEST(LedTolerances, OneSeedOneRealizationWhateverTheCount) {
  LedToleranceKeys keys;
  keys.flux_spread = 0.1;
  const auto five = draw_tolerances(keys, 5, 9.0).fluxes;
  const auto nine = draw_tolerances(keys, 9, 9.0).fluxes;
  EXPECT_TRUE(std::equal(five.begin(), five.end(), nine.begin()));
  keys.seed = 2;
  EXPECT_NE(draw_tolerances(keys, 5, 9.0).fluxes, five);
  EXPECT_TRUE(draw_tolerances(keys, 5, 9.0).offsets.empty());
}

TEST(LedTolerances, PhotonsComeByFlux) {
  const BacklightSpec spec = row("fluxes_lm: [1, 2, 3, 4, 5], off: [1, 4]");
  const Source& source = *spec.sources.front();
  EXPECT_EQ(source.flux(), 10.0);
  EXPECT_EQ(source.windows().size(), 5u);  // a dark LED stays in the way
  constexpr int kPhotons = 50000;
  const auto counts = counts_of(source, kPhotons);
  EXPECT_EQ(counts[0], 0.0);
  EXPECT_EQ(counts[3], 0.0);
  const std::vector<double> lit{counts[1], counts[2], counts[4]};
  EXPECT_GT(chi_square_test(lit, std::vector<double>{0.2 * kPhotons, 0.3 * kPhotons, 0.5 * kPhotons}).p_value, 1e-3);
}

TEST(LedTolerances, PlacesMoveAndStayApart) {
  const BacklightSpec even = row("flux_lm: 2");
  const BacklightSpec spread = row("flux_lm: 2, position_spread_mm: 0.5, tolerance_seed: 3");
  const BacklightSpec again = row("flux_lm: 2, position_spread_mm: 0.5, tolerance_seed: 3");
  const auto a = even.sources.front()->windows();
  const auto b = spread.sources.front()->windows();
  int moved = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(b[i].min_along, again.sources.front()->windows()[i].min_along);
    moved += b[i].min_along != a[i].min_along;
    EXPECT_NEAR(b[i].max_along - b[i].min_along, 2.0, 1e-12);
    EXPECT_TRUE(i == 0 || b[i - 1].max_along <= b[i].min_along);
  }
  EXPECT_EQ(moved, 5);
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 1000; ++i) {
    const Photon photon = spread.sources.front()->emit(rng);
    const SourceWindow& w = b[static_cast<std::size_t>(photon.quad)];
    ASSERT_TRUE(photon.position.y() >= w.min_along && photon.position.y() <= w.max_along);
  }
}

TEST(LedTolerances, EachLedHasItsOwnFactorAndShift) {
  const BacklightSpec even = row("flux_lm: 2, off: [2]");
  const BacklightSpec own =
      row("flux_lm: 2, off: [2], flux_factors: [1, 3, 0.5, 1, 2], offsets_mm: [0, 0.1, -0.2, 3, 3.5], "
          "height_offsets_mm: [0, 0.1, -0.1, 0, 0.05]");
  const Source& source = *own.sources.front();
  EXPECT_NEAR(source.flux(), 2.0 * 4.5, 1e-12);
  const auto a = even.sources.front()->windows(), b = source.windows();
  const std::vector<double> along{0, 0.1, -0.2, 3, 3.5}, height{0, 0.1, -0.1, 0, 0.05};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(b[i].min_along - a[i].min_along, along[i], 1e-12);
    EXPECT_NEAR(b[i].max_z - a[i].max_z, height[i], 1e-12);
  }
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 1000; ++i) {
    const Photon photon = source.emit(rng);
    const SourceWindow& w = b[static_cast<std::size_t>(photon.quad)];
    ASSERT_TRUE(photon.position.y() >= w.min_along && photon.position.y() <= w.max_along);
    ASSERT_TRUE(photon.position.z() >= w.min_z && photon.position.z() <= w.max_z);
  }
  constexpr int kPhotons = 50000;
  const auto counts = counts_of(source, kPhotons);
  EXPECT_EQ(counts[1], 0.0);
  const std::vector<double> lit{counts[0], counts[2], counts[3], counts[4]};
  const double unit = kPhotons / 4.5;
  EXPECT_GT(chi_square_test(lit, std::vector<double>{unit, 0.5 * unit, unit, 2.0 * unit}).p_value, 1e-3);
}

TEST(LedTolerances, FaultsOfFactorsAndShifts) {
  EXPECT_THAT(fault("flux_factors: [1, 2]"),
              HasSubstr("flux_factors: must hold a number for each of the 5 LEDs, got 2"));
  EXPECT_THAT(fault("flux_factors: [1, 1, 0, 1, 1]"), HasSubstr("flux_factors[2]"));
  // 5 mm from LED to LED of 2 mm; 4 mm beside the outermost; 0.1 mm above and below.
  EXPECT_EQ(fault("offsets_mm: [-4, -4, -4, -4, -4]"), "none");
  EXPECT_THAT(
      fault("offsets_mm: [-4.1, 0, 0, 0, 0]"),
      HasSubstr("offsets_mm: must leave the LEDs beside each other on the edge, got a shift that is 0.1 mm too far"));
  EXPECT_THAT(fault("offsets_mm: [0, 0, 1.6, -1.6, 0]"), HasSubstr("0.2 mm too far"));
  EXPECT_THAT(fault("offsets_mm: [0, 0, 1.4, -1.4, 0], position_spread_mm: 0.1"), HasSubstr("offsets_mm"));
  EXPECT_THAT(
      fault("height_offsets_mm: [0, 0.11, 0, 0, 0]"),
      HasSubstr("height_offsets_mm: must keep the LED within the plate's thickness (at most 0.1 mm), got 0.11 mm"));
}

TEST(LedTolerances, Faults) {
  EXPECT_THAT(fault("fluxes_lm: [1, 2]"), HasSubstr("fluxes_lm: must hold a flux for each of the 5 LEDs, got 2"));
  EXPECT_THAT(fault("fluxes_lm: [1, 2, 3, 4, -5]"), HasSubstr("fluxes_lm[4]"));
  EXPECT_THAT(fault("fluxes_lm: [1, 2, 3, 4, 5], flux_lm: 3"), HasSubstr("got both"));
  EXPECT_THAT(fault("off: [6]"), HasSubstr("off[0]: must lie in [1, 5], got 6"));
  EXPECT_THAT(fault("off: [2, 2]"), HasSubstr("off: must not name an LED twice, got 2 again"));
  EXPECT_THAT(fault("off: [1, 2, 3, 4, 5]"), HasSubstr("off: must leave an LED on"));
  EXPECT_THAT(fault("off: [1.5]"), HasSubstr("off"));
  EXPECT_THAT(fault("flux_spread: 0.5"), HasSubstr("flux_spread: must lie in [0, 0.3]"));
  // Room beside each LED: (5 - 2) / 2 mm; a third of it is 0.5 mm.
  EXPECT_EQ(fault("position_spread_mm: 0.5"), "none");
  EXPECT_THAT(fault("position_spread_mm: 0.51"), HasSubstr("position_spread_mm: must be at most 0.5 mm"));
  EXPECT_THAT(fault("tolerance_seed: -1"), HasSubstr("tolerance_seed"));
}

/// LEDs at all four edges through four rows: each edge lets in its share of the light.
TEST(LedTolerances, FourEdges) {
  std::string sources;
  for (const char* edge : {"left", "right", "front", "back"}) {
    sources += std::string("{kind: led_row, edge: ") + edge + ", count: 2, pitch_mm: 4, size_mm: [2, 0.4], flux_lm: ";
    sources += std::string(edge) == "back" ? "3}, " : "1}, ";
  }
  const Traced traced("light_guide_plate: {length_mm: 20, width_mm: 20, thickness_mm: 0.6}, sources: [" + sources + "]",
                      {40000, 5, 100, 2});
  double flux = 0.0;
  for (const auto& source : traced.scene().spec.sources) flux += source->flux();
  EXPECT_EQ(flux, 12.0);
  EXPECT_EQ(traced.accounted(), traced.photons());
  EXPECT_EQ(traced.lost(), 0.0);
  // Without dots most light of a row leaves by the opposite edge, so the front gets that of the brightest row.
  EXPECT_GT(traced.escaped(Side::kFront), 1.8 * traced.escaped(Side::kBack));
  EXPECT_NEAR(traced.escaped(Side::kLeft), traced.escaped(Side::kRight), 6.0 * std::sqrt(traced.photons()));
  for (const Side side : {Side::kLeft, Side::kRight, Side::kFront, Side::kBack}) EXPECT_GT(traced.escaped(side), 0.0);
}

}  // namespace
}  // namespace evenglow::tests
