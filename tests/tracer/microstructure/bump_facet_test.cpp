#include "tracer/microstructure/bump_facet.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/light/fresnel.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
using tracer::DielectricFace;
using tracer::meet_facet;

/// A facet with the tilt of the face itself is the face.
TEST(BumpFacet, LyingFlatIsTheFace) {
  const DielectricFace face(1.5, 1.0);
  for (const bool up : {true, false}) {
    for (const double degrees : {0.0, 20.0, 60.0}) {
      for (const StokesVector& light : test_lights(travel(degrees, 40.0, up))) {
        core::PhotonRng rng({5, 0, 0}, 0), same({5, 0, 0}, 0);
        for (int i = 0; i < 20; ++i) {
          const auto met = meet_facet(face, Vec3::UnitZ(), light, up, rng);
          const StokesVector expected = face.sample(light, same)->light;
          EXPECT_NEAR((met.light.frame.k - expected.frame.k).norm(), 0.0, 1e-14);
          EXPECT_EQ(met.passed, (expected.frame.k.z() > 0.0) == up);
          const StokesVector got = met.light.in_frame(expected.frame.e1);
          EXPECT_NEAR(got.Q, expected.Q, 1e-12);
          EXPECT_NEAR(got.U, expected.U, 1e-12);
          EXPECT_NEAR(got.V, expected.V, 1e-12);
        }
      }
    }
  }
}

/// Tilted facet: Snell's law for the tangential part, Fresnel's odds for s and p light. False alarm 1e-3.
TEST(BumpFacet, TiltedObeysSnellAndFresnel) {
  const Vec3 normal = Vec3(0.3, -0.5, 0.7).normalized();
  const DielectricFace face(1.5, 1.0);
  for (const bool inside : {true, false}) {
    const Vec3 k = (inside ? 1.0 : -1.0) * (normal + 0.4 * normal.unitOrthogonal()).normalized();
    const double cosine = std::abs(k.dot(normal));
    const core::FresnelFace fresnel = core::fresnel(cosine, inside ? 1.5 : 1.0, inside ? 1.0 : 1.5);
    const Vec3 s = k.cross(normal).normalized();
    for (const double angle : {0.0, 0.5 * core::kPi}) {
      const StokesVector light = StokesVector::linear(1.0, angle, core::PolarizationFrame::with_e2(k, s));
      core::PhotonRng rng({6, 0, 0}, inside ? 1 : 0);
      int reflected = 0;
      for (int i = 0; i < 20000; ++i) {
        const auto met = meet_facet(face, normal, light, inside, rng);
        const Vec3 along = k - k.dot(normal) * normal;
        const Vec3& out = met.light.frame.k;
        const double ratio = met.passed ? (inside ? 1.5 : 1.0 / 1.5) : 1.0;
        EXPECT_NEAR((out - out.dot(normal) * normal - ratio * along).norm(), 0.0, 1e-12);
        EXPECT_EQ(out.dot(normal) * k.dot(normal) > 0.0, met.passed);
        reflected += met.passed ? 0 : 1;
        // s and p stay what they are.
        EXPECT_NEAR(met.light.in_frame(s.cross(out)).Q, std::cos(2.0 * angle), 1e-9);
      }
      const double R = angle == 0.0 ? fresnel.reflectance_p() : fresnel.reflectance_s();
      EXPECT_LT(std::abs(binomial_z(reflected, 20000, R)), z_limit(1e-3, 4));
    }
  }
}

/// At grazing incidence the side is the caller's word, not the sign of a rounded cosine.
TEST(BumpFacet, SideIsGiven) {
  const DielectricFace face(1.5, 1.0);
  core::PhotonRng rng({7, 0, 0}, 0);
  const Vec3 k = Vec3(1.0, 0.0, -1e-17);
  const auto met =
      meet_facet(face, Vec3::UnitZ(), StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), true, rng);
  EXPECT_FALSE(met.passed);  // totally reflected, back into the body
}

}  // namespace
}  // namespace evenglow::tests
