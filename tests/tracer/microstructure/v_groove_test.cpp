#include "tracer/microstructure/v_groove.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/flat_limit.h"

namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
using tracer::Ridge;

constexpr double kRad = core::kRadPerDeg;

TEST(VGroove, VanishingHeightIsTheFlatFace) {
  for (const std::string form : {"raised", "sunk"}) {
    expect_flat_face("kind: v_groove, flanks_deg: [0.1, 0.2], axis_deg: 33, form: " + form, 0.03);
  }
}

TEST(VGroove, RidgeOfTwoFlanks) {
  const Ridge ridge(30.0 * kRad, 60.0 * kRad);
  EXPECT_NEAR(ridge.height(), 2.0 * std::tan(30.0 * kRad) * 0.75, 1e-14);  // tan 60 = 3 tan 30
  // The tip lies over x = 0.5.
  EXPECT_NEAR(ridge.span({0.5, 0.0, 0.0}, Vec3::UnitZ()).leave, ridge.height(), 1e-14);
  EXPECT_NEAR(ridge.span({-0.5, 3.0, 0.0}, Vec3::UnitZ()).leave, 0.5 * std::tan(30.0 * kRad), 1e-14);
  EXPECT_NEAR(ridge.normal(1, {}).x(), -0.5, 1e-14);
}

/// Two total reflections at 45 degrees send normal light back on its way: within a raised prism from flank to flank,
/// between sunk grooves from the flank of one to that of the next. The field across the groove gains twice the phase of
/// p, the field along it twice that of s, and one of them changes its sign as in a mirror.
TEST(VGroove, At45ReturnsNormalLightByTwoTotalReflections) {
  const double n = 1.5, i = 45.0 * kRad;
  // tan(d/2) = cos i sqrt(sin^2 i - 1/n^2) / sin^2 i, d = arg r_s - arg r_p (Born & Wolf 1.5.4).
  const double d =
      2.0 * std::atan(std::cos(i) * std::sqrt(std::sin(i) * std::sin(i) - 1.0 / (n * n)) / std::pow(std::sin(i), 2));
  for (const std::string form : {"raised", "sunk"}) {
    for (const std::string face : {"bottom", "top"}) {
      const auto groove = optics_of("kind: v_groove, axis_deg: 90, form: " + form + ", face: " + face, n);
      core::PhotonRng rng({12, 0, 0}, 0);
      for (int photon = 0; photon < 2000; ++photon) {
        // e1 across the groove (x, p), e2 = y along it (s); linear at 45 degrees.
        const core::PolarizationFrame frame{Vec3::UnitZ(), Vec3::UnitX()};
        const auto out = groove->sample(StokesVector::linear(1.0, 45.0 * kRad, frame), rng);
        ASSERT_TRUE(out);
        EXPECT_NEAR((out->light.frame.k + Vec3::UnitZ()).norm(), 0.0, 1e-12);
        // The p axis p = s x k turns with the ray: in the end it is -x. In the frame (e1 = -x, k = -z), e2 = k x e1 =
        // y.
        const StokesVector back = out->light.in_frame(-Vec3::UnitX());
        const std::complex<double> phase = std::polar(1.0, -2.0 * d);  // (r_p conj r_s)^2
        EXPECT_NEAR(back.Q, 0.0, 1e-12);
        EXPECT_NEAR(back.U, phase.real(), 1e-12);
        EXPECT_NEAR(back.V, phase.imag(), 1e-12);
      }
    }
  }
}

/// A flat and a steep flank: normal light leaves a raised prism through the flat flank, bent to the other side; which
/// one faces which way must not depend on the face or the form.
TEST(VGroove, FirstFlankFacesAgainstC) {
  for (const std::string face : {"bottom", "top"}) {
    for (const std::string form : {"raised", "sunk"}) {
      // axis along y: c = +x. The flank of 10 degrees rises from the side of -x.
      const auto groove = optics_of("kind: v_groove, flanks_deg: [10, 85], form: " + form + ", face: " + face, 1.5);
      core::PhotonRng rng({13, 0, 0}, 0);
      int left = 0, right = 0;
      for (int i = 0; i < 4000; ++i) {
        const auto out = groove->sample(StokesVector::unpolarized(1.0, core::PolarizationFrame{}), rng);
        const Vec3& k = out->light.frame.k;
        if (k.z() < 0.0 || std::abs(k.x()) > 0.2) continue;
        (k.x() > 0.0 ? right : left) += 1;
      }
      // A prism of glass bends the ray towards its thick side (+x, under the tip); a dent of air the other way.
      EXPECT_GT(form == "raised" ? right : left, 3000) << face << form;
      EXPECT_LT(form == "raised" ? left : right, 100) << face << form;  // after a reflection or two
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
