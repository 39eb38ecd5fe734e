#include "tracer/optics/opaque_reflector.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

TEST(OpaqueReflector, MirrorKeepsTheTangentialState) {
  core::PhotonRng rng({1, 0, 0}, 0);
  const OpaqueReflector mirror(1.0, 1.0);
  for (const bool up : {false, true}) {
    const Vec3 k = tests::travel(50.0, 110.0, up);
    for (const StokesVector& light : tests::test_lights(k)) {
      const auto out = mirror.sample(light, rng);
      ASSERT_TRUE(out && out->specular);
      EXPECT_NEAR((out->light.frame.k - Vec3(k.x(), k.y(), -k.z())).norm(), 0.0, 1e-15);
      EXPECT_NEAR(out->light.frame.e1.dot(out->light.frame.k), 0.0, 1e-15);
      EXPECT_NEAR(
          (to_film(out->light, tangential_frame(out->light.frame.k)) - to_film(light, tangential_frame(k))).norm(), 0.0,
          1e-14);
    }
  }
}

/// An ideal conductor: r_s = -1, r_p = +1 in the frames of a face. Right circular comes back left circular.
TEST(OpaqueReflector, MirrorTurnsTheHandedness) {
  core::PhotonRng rng({1, 0, 0}, 0);
  const StokesVector right{1.0, 0.0, 0.0, 1.0, core::PolarizationFrame::any(-Vec3::UnitZ())};
  EXPECT_NEAR(OpaqueReflector(1.0, 1.0).sample(right, rng)->light.V, -1.0, 1e-15);
}

TEST(OpaqueReflector, SharesOfMirrorWhiteAndLoss) {
  const OpaqueReflector mixed(0.8, 0.3);
  constexpr int kSamples = 100000;
  for (const bool up : {false, true}) {
    const Vec3 k = tests::travel(40.0, 10.0, up);
    core::PhotonRng rng({20260101, up ? 1U : 0U, 0}, 0);
    double mirrored = 0, lost = 0;
    std::vector<double> polar(20, 0.0);
    for (int i = 0; i < kSamples; ++i) {
      const auto out = mixed.sample(StokesVector::linear(1.0, 0.3, tangential_frame(k).frame), rng);
      if (!out) {
        ++lost;
      } else if (out->specular) {
        ++mirrored;
      } else {
        EXPECT_LT(out->light.frame.k.z() * k.z(), 0.0);
        EXPECT_TRUE(out->light.is_unpolarized());
        const double c = out->light.frame.k.z();
        polar[std::min<std::size_t>(static_cast<std::size_t>((1.0 - c * c) * 20.0), 19)] += 1.0;
      }
    }
    const double chance = tests::sidak(1e-3, 6);
    EXPECT_LT(std::abs(tests::binomial_z(lost, kSamples, 0.2)), tests::two_sided_z(chance));
    EXPECT_LT(std::abs(tests::binomial_z(mirrored, kSamples, 0.24)), tests::two_sided_z(chance));
    const std::vector<double> even(20, (kSamples - lost - mirrored) / 20.0);
    EXPECT_GT(tests::chi_square_test(polar, even).p_value, chance);
  }
}

TEST(OpaqueReflector, EvaluateAndSpecular) {
  const OpaqueReflector mixed(0.8, 0.3);
  const StokesVector light = StokesVector::linear(2.0, 0.3, tangential_frame(tests::travel(40.0, 10.0)).frame);
  EXPECT_NEAR(mixed.evaluate(light, tests::travel(70.0, 0.0, true)).I, 2.0 * 0.8 * 0.7 / core::kPi, 1e-15);
  EXPECT_EQ(mixed.evaluate(light, tests::travel(70.0, 0.0, false)).I, 0.0);
  EXPECT_NEAR(mixed.pdf(light, Vec3::UnitZ()), 0.8 * 0.7 / core::kPi, 1e-15);
  EXPECT_NEAR(mixed.specular(light.frame.k).reflection(0, 0), 0.24, 1e-15);
  EXPECT_TRUE(mixed.specular(light.frame.k).transmission.isZero());
}

/// Reflectance 1 never loses a photon: the white furnace rests on it.
TEST(OpaqueReflector, ReflectanceOneLosesNothing) {
  core::PhotonRng rng({1, 0, 0}, 0);
  const OpaqueReflector white(1.0, 0.0);
  const StokesVector light = StokesVector::unpolarized(1.0, {});
  for (int i = 0; i < 100000; ++i) ASSERT_TRUE(white.sample(light, rng));
}

}  // namespace
}  // namespace evenglow::tracer
