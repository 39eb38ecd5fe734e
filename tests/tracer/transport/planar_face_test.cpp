#include "tracer/transport/planar_face.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/plate_light.h"
#include "tracer/optics/dielectric_face.h"

/// Light through and at bottom and top against the general smooth face, both ways.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

constexpr double kIndex = 1.49;
constexpr int kLights = 20000;

StokesVector light_at(bool upward, bool inside, core::PhotonRng& rng) {
  // From inside within the critical angle: total reflection is the walk's own part.
  const double most = inside ? 0.999 / kIndex : 0.999;
  const double sine = most * std::sqrt(rng.uniform());
  const double azimuth = 2.0 * core::kPi * rng.uniform();
  const double cosine = std::sqrt(1.0 - sine * sine);
  const Vec3 k(sine * std::cos(azimuth), sine * std::sin(azimuth), upward ? cosine : -cosine);
  return polarized_light(k, rng);
}

/// Equal light whichever way it goes, and as often through: false alarm 6e-6 for each of the four cases.
void compare(int side, bool inside) {
  const PlanarPlate plate = bare_plate(kIndex);
  PlanarPlateState<MeridianLight> state(plate);
  const bool top = side == static_cast<int>(Side::kTop);
  const DielectricFace face(top ? kIndex : 1.0, top ? 1.0 : kIndex);
  core::PhotonRng rng({5, static_cast<std::uint32_t>(side), inside ? 1u : 0u}, 0);
  int passes = 0, expected = 0;
  for (int i = 0; i < kLights; ++i) {
    const StokesVector light = light_at(top == inside, inside, rng);
    Photon photon;
    photon.light = light;
    state.load(photon);
    PlanarFace<MeridianLight> planar(state, side);
    const bool passed = inside ? planar.lets_out(photon, rng) : planar.lets_in(photon, rng);
    passes += passed ? 1 : 0;
    auto sample = face.sample(light, rng);
    const auto crossed = [&] { return sample->light.frame.k.z() * light.frame.k.z() > 0.0; };
    expected += crossed() ? 1 : 0;
    for (int tries = 0; tries < 2000 && crossed() != passed; ++tries) sample = face.sample(light, rng);
    ASSERT_EQ(crossed(), passed);
    const StokesVector got = state.light.stokes();
    const StokesVector want = sample->light.in_frame(got.frame.e1);
    ASSERT_LT((got.frame.k - want.frame.k).norm(), 1e-9);
    ASSERT_NEAR(got.Q, want.Q, 1e-9);
    ASSERT_NEAR(got.U, want.U, 1e-9);
    ASSERT_NEAR(got.V, want.V, 1e-9);
  }
  const double share = 0.5 * (passes + expected) / kLights;
  EXPECT_LT(std::abs(passes - expected), 4.5 * std::sqrt(2.0 * kLights * share * (1.0 - share)));
}

TEST(PlanarFace, LetsLightOutAsTheSmoothFaceDoes) {
  compare(static_cast<int>(Side::kBottom), true);
  compare(static_cast<int>(Side::kTop), true);
}

TEST(PlanarFace, LetsLightInAsTheSmoothFaceDoes) {
  compare(static_cast<int>(Side::kBottom), false);
  compare(static_cast<int>(Side::kTop), false);
}

}  // namespace
}  // namespace evenglow::tests
