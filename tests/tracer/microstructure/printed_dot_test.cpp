#include "tracer/microstructure/printed_dot.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

using tracer::Side;

std::string plate_with(const std::string& dots, const std::string& face, const std::string& lit) {
  // An index next to 1 (R = 2.5e-9 a face) leaves nothing but the dots; the photon meets their face once.
  return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1, refractive_index: 1.0001}, microstructure: "
         "{face: " +
         face + ", cells: [4, 2], " + dots + "}, sources: [{kind: beam, face: " + lit +
         ", size_share: 1, gap_mm: 0.5}]";
}

/// Chance of a hit = density, from inside and from outside, on either face. False alarm 1e-3.
TEST(PrintedDot, IsMetWithTheOddsOfTheDensity) {
  for (const char* face : {"bottom", "top"}) {
    for (const char* lit : {"bottom", "top"}) {
      const Traced traced(plate_with("density: 0.3, reflectance: 0", face, lit), {40'000, 1, 10, 1});
      EXPECT_LT(std::abs(binomial_z(traced.absorbed("microstructure"), traced.photons(), 0.3)), z_limit(1e-3, 4))
          << face << lit;
      EXPECT_EQ(traced.accounted(), traced.photons());
    }
  }
}

TEST(PrintedDot, InkReflectsItsShare) {
  const Traced traced(plate_with("density: 1, reflectance: 0.8", "bottom", "bottom"), {40'000, 2, 10, 1});
  EXPECT_LT(std::abs(binomial_z(traced.absorbed("microstructure"), traced.photons(), 0.2)), two_sided_z(1e-3));
  EXPECT_EQ(traced.escaped(Side::kTop), 0.0);
  EXPECT_GT(traced.escaped(Side::kBottom), 0.79 * traced.photons());
}

TEST(PrintedDot, DefaultsAndFaults) {
  const tracer::BacklightSpec spec = backlight_of(plate_with("density: 0.3", "bottom", "top"));
  ASSERT_TRUE(spec.microstructure);
  EXPECT_EQ(spec.microstructure->shape.kind, "printed_dot");
  EXPECT_TRUE(spec.microstructure->shape.optics(1.49)->scatters());
  EXPECT_THROW(backlight_of(plate_with("reflectance: 1.5", "bottom", "top")), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests
