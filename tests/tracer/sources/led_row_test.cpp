#include "tracer/sources/led_row.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string row(const std::string& keys) {
  return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, sources: [{kind: led_row, " + keys +
         "}]";
}

std::string fault_of(const std::string& keys) {
  try {
    backlight_of(row(keys));
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(LedRow, WindowsAreCenteredAndEvenlySpaced) {
  const BacklightSpec spec = backlight_of(row("edge: left, count: 3, pitch_mm: 3, size_mm: [2, 0.4], flux_lm: 5"));
  const Source& source = *spec.sources.front();
  EXPECT_EQ(source.flux(), 15.0);
  const auto windows = source.windows();
  ASSERT_EQ(windows.size(), 3U);
  EXPECT_DOUBLE_EQ(windows[0].min_along, 1.0);
  EXPECT_DOUBLE_EQ(windows[1].min_along, 4.0);
  EXPECT_DOUBLE_EQ(windows[2].max_along, 9.0);
  EXPECT_DOUBLE_EQ(windows[0].min_z, 0.1);
  EXPECT_DOUBLE_EQ(windows[0].max_z, 0.5);
  const BacklightSpec shared = backlight_of(row("edge: front, count: 4, size_mm: [1, 0.4]"));
  EXPECT_DOUBLE_EQ(shared.sources.front()->windows()[0].min_along, 2.0);  // pitch 20 / 4, along x
}

TEST(LedRow, PhotonsStartInTheWindowsAllAlike) {
  for (const char* edge : {"left", "right", "front", "back"}) {
    const BacklightSpec spec =
        backlight_of(row(std::string("edge: ") + edge + ", count: 3, pitch_mm: 3, size_mm: [2, 0.4], gap_mm: 0.1"));
    const Source& source = *spec.sources.front();
    const Side side = source.side();
    const int along = axis_of(side) == 0 ? 1 : 0;
    const auto windows = source.windows();
    std::vector<double> counts(3 * 4 * 4, 0.0);
    constexpr int kPhotons = 20000;
    core::PhotonRng rng({20260101, 0, 0}, 0);
    for (int i = 0; i < kPhotons; ++i) {
      const Photon photon = source.emit(rng);
      const SourceWindow& w = windows.at(static_cast<std::size_t>(photon.quad));
      ASSERT_DOUBLE_EQ(photon.position[axis_of(side)], spec.area.plane(side) + 0.1 * outward(side)[axis_of(side)]);
      const double u = (photon.position[along] - w.min_along) / (w.max_along - w.min_along);
      const double v = (photon.position.z() - w.min_z) / (w.max_z - w.min_z);
      ASSERT_TRUE(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0);
      ASSERT_LT(photon.light.frame.k.dot(outward(side)), 0.0);
      const int bin =
          photon.quad * 16 + std::min(3, static_cast<int>(4 * u)) * 4 + std::min(3, static_cast<int>(4 * v));
      counts[static_cast<std::size_t>(bin)] += 1.0;
    }
    EXPECT_GT(chi_square_test(counts, std::vector<double>(48, kPhotons / 48.0)).p_value, sidak(1e-3, 4)) << edge;
  }
}

/// Flux of the intensity cos^n: mean cosine (n + 1) / (n + 2), variance (n + 1) / (n + 3) - mean^2.
TEST(LedRow, CosinePower) {
  for (const double n : {1.0, 4.0}) {
    const BacklightSpec spec =
        backlight_of(row("edge: left, count: 1, pattern: cosine_power, exponent: " + text_of(n)));
    core::PhotonRng rng({20260101, 0, 0}, 0);
    constexpr int kPhotons = 100000;
    double sum = 0.0;
    for (int i = 0; i < kPhotons; ++i) sum += spec.sources.front()->emit(rng).light.frame.k.x();
    const double mean = (n + 1.0) / (n + 2.0);
    const double se = std::sqrt(((n + 1.0) / (n + 3.0) - mean * mean) / kPhotons);
    EXPECT_LT(std::abs(z_score({sum / kPhotons, se}, mean)), z_limit(1e-3, 2));
  }
}

TEST(LedRow, NamesWhatDoesNotFit) {
  EXPECT_NE(fault_of("count: 3, pitch_mm: 5, size_mm: [2, 0.4]").find("pitch_mm"), std::string::npos);
  EXPECT_NE(fault_of("count: 3, pitch_mm: 1, size_mm: [2, 0.4]").find("pitch_mm"), std::string::npos);
  EXPECT_NE(fault_of("count: 1, size_mm: [2, 0.7]").find("size_mm"), std::string::npos);
  EXPECT_NE(fault_of("count: 1, size_mm: [11, 0.4]").find("size_mm"), std::string::npos);
  EXPECT_NE(fault_of("count: 0").find("count"), std::string::npos);
  EXPECT_EQ(fault_of("count: 3, pitch_mm: 4, size_mm: [2, 0.6]"), "");
}

/// Light that comes back to a window is met by it, not by the frame around it.
TEST(LedRow, WindowsStandInTheWayOfReturningLight) {
  const std::string mirrors =
      ", reflectors: {right: {kind: mirror, reflectance: 1}, left: {kind: mirror, reflectance: 1, gap_mm: ";
  for (const char* gap : {"0.05}}", "0.2}}"}) {
    const Traced traced(row("edge: left, count: 1, size_mm: [10, 0.6], gap_mm: 0.05, reflectance: 0") + mirrors + gap,
                        {10000, 3, 100, 1});
    // The rest slips out between plate and mirrors.
    EXPECT_GT(traced.absorbed("sources[0]:led_row"), 0.6 * traced.photons()) << gap;
    EXPECT_EQ(traced.absorbed("sources"), traced.absorbed("sources[0]:led_row"));
    EXPECT_EQ(traced.absorbed("reflectors.left"), 0.0);
    EXPECT_EQ(traced.lost(), 0.0);
  }
}

}  // namespace
}  // namespace evenglow::tests
