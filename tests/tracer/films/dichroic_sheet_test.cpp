#include "tracer/films/dichroic_sheet.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"
#include "tests/support/specular_checks.h"
#include "tracer/films/faced_body.h"
#include "tracer/films/lpp.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::travel;

/// Greatest and least transmittance over all polarizations.
std::pair<double, double> principal(const core::MuellerMatrix& T) {
  const double part = T.row(0).tail<3>().norm();
  return {T(0, 0) + part, T(0, 0) - part};
}

TEST(DichroicSheet, IsTheSimplePolarizerAtNormalIncidence) {
  for (const double index : {1.4, 1.5, 1.7}) {
    for (const bool up : {false, true}) {
      const core::Vec3 k = travel(0, 0, up);
      const auto sheet = DichroicSheet({0.85, 0.003, 0.6, index, 0.04}).specular(k);
      const auto simple = lpp_surface({0.85, 0.003, 0.04, 0.6}).specular(k);
      EXPECT_TRUE(sheet.transmission.isApprox(simple.transmission, 1e-12));
      EXPECT_TRUE(sheet.reflection.isApprox(simple.reflection, 1e-12));
    }
  }
}

/// With smooth faces k1 and k2 are still those of the whole sheet at normal incidence.
TEST(DichroicSheet, FacesAreIncludedInK) {
  const auto [k1, k2] = principal(DichroicSheet({0.86, 0.02, 0.3, 1.5, {}}).specular(travel(0, 0)).transmission);
  EXPECT_NEAR(k1, 0.86, 1e-12);
  EXPECT_NEAR(k2, 0.02, 1e-12);
}

TEST(DichroicSheet, PathAndProjectionByHand) {
  const double n = 1.5, k1 = 0.81, k2 = 0.09, R = 0.1;
  const double inner = std::asin(std::sin(60 * kRad) / n);
  // Plane of incidence along the pass axis: block axis across the plane, at right angles to the ray: path alone.
  auto [most, least] = principal(DichroicSheet({k1, k2, 0.0, n, R}).specular(travel(60, 0)).transmission);
  EXPECT_NEAR(most, 0.9 * std::pow(0.9, 1 / std::cos(inner)), 1e-12);
  EXPECT_NEAR(least, 0.9 * std::pow(0.1, 1 / std::cos(inner)), 1e-12);
  // Along the block axis: the extraordinary field keeps cos(inner) along the dye, so its absorbance is
  // (alpha_p sin^2 + alpha_b cos^2) d / cos.
  std::tie(most, least) = principal(DichroicSheet({k1, k2, 0.0, n, R}).specular(travel(60, 90)).transmission);
  EXPECT_NEAR(most, 0.9 * std::pow(0.9, 1 / std::cos(inner)), 1e-12);
  const double s2 = std::pow(std::sin(inner), 2);
  EXPECT_NEAR(least, 0.9 * std::exp((std::log(0.9) * s2 + std::log(0.1) * (1 - s2)) / std::cos(inner)), 1e-12);
}

/// Malus at every angle against the axis that the ray sees.
TEST(DichroicSheet, MalusObliquely) {
  const DichroicSheet film({0.96, 0.0, 0.5, 1.5, 0.04});
  const core::Vec3 k = travel(50, 20, true);
  const auto frame = tangential_frame(k);
  const double psi = 0.5 - 20 * kRad;
  const double inner = std::asin(std::sin(50 * kRad) / 1.5);
  const double chi = std::atan(std::tan(psi) * std::cos(inner));
  for (double a = 0; a < 3.2; a += 0.3) {
    const auto out = tests::passed(film, core::StokesVector::linear(1, a, frame.frame));
    EXPECT_NEAR(out.I, 0.96 * std::pow(std::cos(a - chi), 2), 1e-12);
  }
}

/// p light at Brewster's angle in the plane of the pass axis meets no face: only the body is left.
TEST(DichroicSheet, BrewsterFaces) {
  const double n = 1.5, k1 = 0.8;
  const double sigma = std::atan(n);
  const core::Vec3 k(std::sin(sigma), 0, std::cos(sigma));
  const DichroicSheet film({k1, 0.0, 0.0, n, {}});
  const auto p = core::StokesVector::linear(1, 0, tangential_frame(k).frame);
  EXPECT_NEAR(tests::passed(film, p).I, std::pow(body_transmittance(k1, n), 1 / std::sin(sigma)), 1e-12);
  EXPECT_NEAR((film.specular(k).reflection * Eigen::Vector4d(1, 1, 0, 0))[0], 0.0, 1e-12);
}

TEST(DichroicSheet, PassiveAndReciprocal) {
  tests::expect_passive_and_reciprocal(DichroicSheet({}));
  tests::expect_passive_and_reciprocal(DichroicSheet({0.85, 0.1, 1.0, 1.7, {}}));
  tests::expect_passive_and_reciprocal(DichroicSheet({greatest_through_faces(1.5), 0.0, 2.0, 1.5, {}}));
}

TEST(DichroicSheet, RefusesGain) {
  EXPECT_THROW(DichroicSheet({0.97, 0.0, 0.0, 1.5, 0.04}), core::Error);
  EXPECT_THROW(DichroicSheet({0.93, 0.0, 0.0, 1.5, {}}), core::Error);
  EXPECT_THROW(DichroicSheet({0.5, 0.6, 0.0, 1.5, 0.04}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
