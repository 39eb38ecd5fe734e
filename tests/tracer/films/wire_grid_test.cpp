#include "tracer/films/wire_grid.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"
#include "tests/support/specular_checks.h"
#include "tracer/films/ideal_polarizer.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::travel;

TEST(WireGrid, HasItsPowersAtNormalIncidence) {
  const WireGrid film({0.85, 0.05, 0.001, 0.88}, 0.6);
  for (const bool up : {false, true}) {
    const core::Vec3 k = travel(0, 0, up);
    const auto s = film.specular(k);
    const auto power = [&](const core::MuellerMatrix& M, double azimuth) {
      const core::PolarizationFrame frame{k, core::Vec3(std::cos(azimuth), std::sin(azimuth), 0)};
      return (M * to_film(core::StokesVector::linear(1, 0, frame), tangential_frame(k)))[0];
    };
    EXPECT_NEAR(power(s.transmission, 0.6), 0.85, 1e-12);
    EXPECT_NEAR(power(s.reflection, 0.6), 0.05, 1e-12);
    EXPECT_NEAR(power(s.transmission, 0.6 + 0.5 * core::kPi), 0.001, 1e-12);
    EXPECT_NEAR(power(s.reflection, 0.6 + 0.5 * core::kPi), 0.88, 1e-12);
  }
}

/// Perfect wires conduct in one direction only: the field along them is zero, so the tangential part of what passes
/// lies across them; that is the ideal polarizer counted with the index of air, at every angle.
TEST(WireGrid, PerfectWiresAreTheUnidirectionalScreen) {
  const WireGrid film({1.0, 0.0, 0.0, 1.0}, 0.6);
  const IdealPolarizer ideal({1.0, 0.0, 0.0, 1.0}, 0.6, 1.0 + 1e-14);
  for (const core::Vec3& k : tests::many_directions()) {
    EXPECT_LT((film.specular(k).transmission - ideal.specular(k).transmission).norm(), 1e-9) << k.transpose();
    EXPECT_LT((film.specular(k).reflection - ideal.specular(k).reflection).norm(), 1e-9) << k.transpose();
  }
}

/// In the principal planes s and p part. A thin lossless grid of admittance i b has t = 2 Y0 / (2 Y0 + i b), with b^2 =
/// 4 R / T at normal incidence, Y0 = cos for s and 1 / cos for p; capacitive or inductive, the powers are the same.
TEST(WireGrid, ThinGridInThePrincipalPlanes) {
  const double T = 0.7, R = 0.3, Tb = 0.05, Rb = 0.95;
  const WireGrid film({T, R, Tb, Rb}, 0.0);
  for (const double sigma : {1.0, 30.0, 60.0, 80.0}) {
    const double c2 = std::pow(std::cos(sigma * kRad), 2);
    const auto passed = [&](double azimuth, double q) {
      return (film.specular(travel(sigma, azimuth)).transmission * Eigen::Vector4d(1, q, 0, 0))[0];
    };
    EXPECT_NEAR(passed(0, 1), T / (T + R * c2), 1e-12);      // field across the wires, in the plane of incidence
    EXPECT_NEAR(passed(90, -1), T / (T + R / c2), 1e-12);    // across the wires and across the plane
    EXPECT_NEAR(passed(90, 1), Tb / (Tb + Rb * c2), 1e-12);  // along the wires, in the plane
    EXPECT_NEAR(passed(0, -1), Tb / (Tb + Rb / c2), 1e-12);  // along the wires, across the plane
  }
}

/// A film that absorbs: with Y = (1 - g) / (1 + g), G = (Y0 - Y) / (Y0 + Y), wall by wall.
TEST(WireGrid, AbsorbingFilmInThePrincipalPlanes) {
  const double T = 0.6, R = 0.3;
  const std::complex<double> i(0, 1), e = (std::sqrt(T) + i * std::sqrt(R)) / std::sqrt(T + R);
  const std::complex<double> t = std::sqrt(T) * e, r = i * std::sqrt(R) * e;
  const WireGrid film({T, R, 0.0, 1.0}, 0.0);
  for (const double sigma : {1.0, 30.0, 60.0, 80.0}) {
    const double c = std::cos(sigma * kRad);
    for (const bool p : {true, false}) {
      const core::Vec3 k = travel(sigma, p ? 0 : 90);
      const double y0 = p ? 1 / c : c;
      const auto wall = [&](std::complex<double> g) {
        const auto y = (1.0 - g) / (1.0 + g);
        return (y0 - y) / (y0 + y);
      };
      const auto even = wall(r + t), odd = wall(r - t);
      const Eigen::Vector4d light(1, p ? 1 : -1, 0, 0);
      EXPECT_NEAR((film.specular(k).transmission * light)[0], std::norm(0.5 * (even - odd)), 1e-12);
      EXPECT_NEAR((film.specular(k).reflection * light)[0], std::norm(0.5 * (even + odd)), 1e-12);
    }
  }
}

/// T + R = 1 for every polarization at every angle.
TEST(WireGrid, LosslessFilmKeepsAllEnergy) {
  const WireGrid film({0.9, 0.1, 0.02, 0.98}, 1.1);
  for (const core::Vec3& k : tests::many_directions()) {
    const auto s = film.specular(k);
    EXPECT_NEAR(s.transmission(0, 0) + s.reflection(0, 0), 1.0, 1e-9);
    EXPECT_NEAR((s.transmission + s.reflection).row(0).tail<3>().norm(), 0.0, 1e-9);
  }
}

TEST(WireGrid, PassiveAndReciprocal) {
  for (const WireGrid::Powers& p : {WireGrid::Powers{},
                                    {1, 0, 0, 1},
                                    {0.5, 0.0, 0.5, 0.0},
                                    {0.0, 0.0, 0.0, 0.0},
                                    {0.3, 0.7, 0.1, 0.2},
                                    {0.86, 0.1, 1e-6, 0.85}}) {
    tests::expect_passive_and_reciprocal(WireGrid(p, 0.9));
  }
}

TEST(WireGrid, RefusesGain) {
  EXPECT_THROW(WireGrid({0.9, 0.2, 0.0, 1.0}, 0.0), core::Error);
  EXPECT_THROW(WireGrid({0.9, 0.1, 0.1, 0.95}, 0.0), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
