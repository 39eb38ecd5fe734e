#include "tracer/optics/lobe_width.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tracer/films/diffuser.h"
#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

/// A Gaussian lobe of `haze` of what passes.
bool spreads(double fwhm_deg, double haze, double least_deg) {
  const Diffuser film({.transmittance = 1.0, .reflectance = 0.0, .haze = haze, .fwhm = fwhm_deg * core::kRadPerDeg});
  return spreads_over(film, least_deg * core::kRadPerDeg);
}

TEST(LobeWidth, OfAGaussianLobe) {
  EXPECT_TRUE(spreads(12, 1, 10.9));
  EXPECT_FALSE(spreads(12, 1, 12.1));
  EXPECT_TRUE(spreads(12, 1, 0));
}

TEST(LobeWidth, AFaintHazeIsAsWideAsAStrongOne) {
  for (const double haze : {0.01, 1.0}) {
    EXPECT_TRUE(spreads(30, haze, 20)) << haze;
    EXPECT_FALSE(spreads(30, haze, 35)) << haze;
  }
}

TEST(LobeWidth, OfWhatReflects) {
  EXPECT_TRUE(spreads_over(OpaqueReflector(0.9, 0.0), 80.0 * core::kRadPerDeg));
}

}  // namespace
}  // namespace evenglow::tests
