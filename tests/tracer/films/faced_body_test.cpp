#include "tracer/films/faced_body.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {
namespace {

TEST(FacedBody, ClearAndGrayBodiesAreTheIncoherentSheet) {
  for (const double n : {1.3, 1.5, 2.0}) {
    for (const double sigma : {0.0, 20.0, 56.3, 75.0, 89.0}) {
      for (const double absorption : {0.0, 1.5}) {
        const double c = std::cos(sigma * core::kRadPerDeg);
        const double inner = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
        const auto sheet = incoherent_sheet(c, n, absorption, 0.3);
        const auto body = std::exp(-absorption * 0.3 / inner) * core::MuellerMatrix::Identity();
        const auto faced = faced_body(body, c, n);
        EXPECT_TRUE(faced.transmission.isApprox(sheet.transmission, 1e-10)) << n << " " << sigma;
        EXPECT_TRUE(faced.reflection.isApprox(sheet.reflection, 1e-10)) << n << " " << sigma;
      }
    }
  }
}

/// The sum over orders as written out, for a body that mixes the states.
TEST(FacedBody, OrdersOfReflectionByHand) {
  const double n = 1.6, c = std::cos(1.0);
  const core::MuellerMatrix B =
      core::rotator(-0.4) * core::retarder(1.1) * core::diattenuator(0.9, 0.6) * core::rotator(0.4);
  const DielectricFace in(1.0, n), out(n, 1.0);
  const core::Vec3 k(std::sin(1.0), 0, c);
  const core::Vec3 inside(k.x() / n, 0, std::sqrt(1 - k.x() * k.x() / n / n));
  const auto front = in.specular(k), far = out.specular(inside);
  const auto near = DielectricFace(1.0, n).specular({inside.x(), 0, -inside.z()});
  core::MuellerMatrix T = core::MuellerMatrix::Zero(), R = front.reflection;
  core::MuellerMatrix up = front.transmission;  // just inside the lower face
  for (int order = 0; order < 40; ++order) {
    const core::MuellerMatrix at_top = B * up;
    T += far.transmission * at_top;
    const core::MuellerMatrix at_bottom = B * far.reflection * at_top;
    R += near.transmission * at_bottom;
    up = near.reflection * at_bottom;
  }
  const auto faced = faced_body(B, c, n);
  EXPECT_TRUE(faced.transmission.isApprox(T, 1e-12)) << faced.transmission << "\n\n" << T;
  EXPECT_TRUE(faced.reflection.isApprox(R, 1e-12)) << faced.reflection << "\n\n" << R;
}

TEST(FacedBody, BodyTransmittanceInvertsTheSheet) {
  for (const double n : {1.0001, 1.5, 2.5}) {
    for (const double a : {0.0, 1e-6, 0.3, 0.999, 1.0}) {
      const double total = faced_body(a * core::MuellerMatrix::Identity(), 1.0, n).transmission(0, 0);
      EXPECT_NEAR(body_transmittance(total, n), a, 1e-12);
      EXPECT_LE(total, greatest_through_faces(n) + 1e-15);
    }
  }
  EXPECT_NEAR(greatest_through_faces(1.5), 0.96 / 1.04, 1e-15);
}

}  // namespace
}  // namespace evenglow::tracer
