#include "tracer/transport/planar_diffuser.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/plate_light.h"

/// Held against `Diffuser`, with the same random numbers: the same light, but for rounding.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

StokesVector random_light(core::PhotonRng& rng) {
  const Vec3 k = random_direction(rng);
  return polarized_light(k, rng);
}

void expect_same(const MeridianLight& mine, const StokesVector& theirs) {
  const StokesVector a = mine.stokes();
  const StokesVector b = theirs.in_frame(a.frame.e1);
  EXPECT_LT((a.frame.k - b.frame.k).norm(), 1e-12);
  EXPECT_NEAR(a.Q, b.Q, 1e-9);
  EXPECT_NEAR(a.U, b.U, 1e-9);
  EXPECT_NEAR(a.V, b.V, 1e-9);
}

TEST(PlanarDiffuser, CarriesPolarizationByTheShortestWay) {
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 3000; ++i) {
    const StokesVector light = random_light(rng);
    Vec3 to = random_direction(rng);
    if (to.z() * light.frame.k.z() < 0.0) to.z() = -to.z();  // `scattered_light` mirrors else
    if (i % 3 == 0) to = (light.frame.k + 1e-3 * to).normalized();
    MeridianLight mine(light);
    ASSERT_TRUE(carry_to(to, mine));
    expect_same(mine, scattered_light(light, to, 0.0));
  }
}

/// Where no meridian frame is defined, nothing is done.
TEST(PlanarDiffuser, LeavesTheNormalToTheGeneralWay) {
  const auto light = StokesVector::linear(1.0, 0.3, core::PolarizationFrame::any(Vec3::UnitZ()));
  MeridianLight mine(light);
  EXPECT_FALSE(carry_to(Vec3(0.6, 0.0, 0.8), mine));
  expect_same(mine, light);
}

TEST(PlanarDiffuser, TheSameLightByTheSameNumbers) {
  Diffuser::Spec gaussian{.transmittance = 0.7, .reflectance = 0.2, .haze = 0.8, .fwhm = 0.5, .depolarization = 0.3};
  Diffuser::Spec lambertian{.transmittance = 0.5, .reflectance = 0.4, .haze = 1.0, .depolarization = 0.1};
  for (const auto& spec : {gaussian, lambertian}) {
    const Diffuser diffuser(spec);
    core::PhotonRng lights({2, 0, 0}, 0);
    int absorbed = 0, straight = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const StokesVector light =
          i == 0 ? StokesVector::linear(1.0, 0.3, core::PolarizationFrame::any(Vec3::UnitZ())) : random_light(lights);
      core::PhotonRng one({3, 0, 0}, i), other({3, 0, 0}, i);
      const auto sample = diffuser.sample(light, one);
      MeridianLight mine(light);
      const DiffuserEnd end = pass_diffuser(diffuser, mine, other);
      ASSERT_EQ(end == DiffuserEnd::kAbsorbed, !sample.has_value());
      absorbed += sample ? 0 : 1;
      if (!sample) continue;
      straight += sample->specular ? 1 : 0;
      EXPECT_EQ(end == DiffuserEnd::kStraight, sample->specular);
      expect_same(mine, sample->light);
    }
    EXPECT_GT(absorbed, 100);
    EXPECT_EQ(straight > 0, spec.haze < 1.0);
  }
}

}  // namespace
}  // namespace evenglow::tests
