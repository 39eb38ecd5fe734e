#include "core/math/lambertian.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"

namespace evenglow::core {
namespace {

/// cos(theta) / pi: the means of z, z^2, x and x^2 are 2/3, 1/2, 0 and 1/4, their variances 1/18, 1/12, 1/4 and 1/16.
/// 5 sigma, four comparisons: false alarm 2e-6.
TEST(DrawLambertian, MomentsOfLambertsLaw) {
  PhotonRng rng({1, 0, 0}, 0);
  constexpr int kDraws = 200'000;
  double z = 0.0, z2 = 0.0, x = 0.0, x2 = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 k = draw_lambertian(rng);
    ASSERT_NEAR(k.squaredNorm(), 1.0, 1e-15);
    ASSERT_GT(k.z(), 0.0);
    z += k.z() / kDraws;
    z2 += k.z() * k.z() / kDraws;
    x += k.x() / kDraws;
    x2 += k.x() * k.x() / kDraws;
  }
  const double five = 5.0 / std::sqrt(static_cast<double>(kDraws));
  EXPECT_NEAR(z, 2.0 / 3, five * std::sqrt(1.0 / 18));
  EXPECT_NEAR(z2, 0.5, five * std::sqrt(1.0 / 12));
  EXPECT_NEAR(x, 0.0, five * 0.5);
  EXPECT_NEAR(x2, 0.25, five * 0.25);
}

}  // namespace
}  // namespace evenglow::core
