#include "tracer/films/carrier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_yaml.h"
#include "tests/support/films.h"
#include "tests/support/specular_checks.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::film_faults;
using tests::film_from;
using tests::travel;

TEST(Carrier, WithoutSpreadIsARetarder) {
  const Film carrier = film_from(
      "{kind: carrier, axis_deg: 20, retardance_nm: 700, retardance_spread_nm: 0, bandwidth_nm: 0, birefringence: "
      "0.1}");
  const Film retarder = film_from(
      "{kind: retarder, axis_deg: 20, retardance_nm: 700, refractive_index: 1.64, birefringence: 0.1, faces: fresnel}");
  for (const core::Vec3& k : tests::many_directions()) {
    for (const double nm : {450.0, 550.0, 650.0}) {
      EXPECT_TRUE(carrier.at_wavelength(nm).surface->specular(k).transmission.isApprox(
          retarder.at_wavelength(nm).surface->specular(k).transmission, 1e-12));
    }
  }
}

/// Only light along and across the axis keeps its polarization: U and V of the film's axes are gone, Q stays.
TEST(Carrier, LargeSpreadTakesUAndV) {
  const Film film = film_from("{kind: carrier, retardance_spread_nm: 5000, faces: coated}");
  const auto T = film.surface->specular(travel(0, 0)).transmission;
  const core::MuellerMatrix expected = Eigen::Vector4d(1, 1, 0, 0).asDiagonal();
  EXPECT_LT((T - expected).norm(), 1e-12);
}

/// The default carrier depolarizes light at 45 degrees to a few percent.
TEST(Carrier, DefaultDepolarizes) {
  const Film film = film_from("{kind: carrier, faces: coated}");
  const Eigen::Vector4d out = film.surface->specular(travel(0, 0)).transmission * Eigen::Vector4d(1, 0, 1, 0);
  const double phase = 2 * core::kPi / 550;
  const double variance = phase * phase * (100.0 * 100.0 + std::pow(4000.0 * 20.0 / 550.0, 2));
  const double left = std::exp(-0.5 * variance);
  EXPECT_NEAR(std::hypot(out[2], out[3]), left, 1e-12);
  EXPECT_NEAR(out[2], left * std::cos(phase * 4000), 1e-12);
  EXPECT_LT(left, 0.2);
}

/// A band of wavelengths, summed: Gaussian weights around 550 nm. The formula takes the phase as linear in the
/// wavelength, which holds to the second order of bandwidth / wavelength.
TEST(Carrier, BandwidthIsTheMeanOverWavelengths) {
  const std::string base =
      "{kind: carrier, faces: coated, retardance_nm: 3000, retardance_spread_nm: 0, bandwidth_nm: ";
  const Film mono = film_from(base + "0}");
  core::MuellerMatrix sum = core::MuellerMatrix::Zero();
  double weight = 0;
  for (double x = -6; x <= 6; x += 0.05) {
    const double w = std::exp(-0.5 * x * x);
    sum += w * mono.at_wavelength(550 + 10 * x).surface->specular(travel(0, 0)).transmission;
    weight += w;
  }
  const auto T = film_from(base + "10}").surface->specular(travel(0, 0)).transmission;
  EXPECT_LT((T - sum / weight).norm(), 0.02);
  EXPECT_LT(std::hypot(T(2, 2), T(2, 3)), 0.9);
}

TEST(Carrier, PassiveAndReciprocal) {
  tests::expect_passive_and_reciprocal(*film_from("{kind: carrier, axis_deg: 12}").surface);
}

TEST(Carrier, NamesFaults) {
  EXPECT_THAT(film_faults("{kind: carrier, bandwidth_nm: 400}"), HasSubstr("bandwidth_nm"));
  EXPECT_THAT(film_faults("{kind: carrier, retardance_nm: -3}"), HasSubstr("retardance_nm"));
  EXPECT_THAT(film_faults("{kind: carrier, plate: half}"), HasSubstr("plate"));
}

}  // namespace
}  // namespace evenglow::tracer
