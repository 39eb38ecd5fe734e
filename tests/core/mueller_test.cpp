#include "core/light/mueller.h"

#include <cmath>
#include <complex>
#include <random>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::core {
namespace {

/// A polarizer whose pass axis lies at `angle` from e1.
MuellerMatrix polarizer(double angle, double k1 = 1.0, double k2 = 0.0) {
  return rotator(-angle) * diattenuator(k1, k2) * rotator(angle);
}

/// Mueller matrix of a Jones matrix, column by column from the fields of six states: independent of the formulas in
/// the code.
MuellerMatrix of_jones(const Eigen::Matrix2cd& J) {
  using C = std::complex<double>;
  const auto stokes = [&](C a, C b) {
    const Eigen::Vector2cd E = J * Eigen::Vector2cd(a, b);
    const C uv = 2.0 * E[0] * std::conj(E[1]);
    return Eigen::Vector4d(E.squaredNorm(), std::norm(E[0]) - std::norm(E[1]), uv.real(), uv.imag());
  };
  const double h = std::sqrt(0.5);
  const Eigen::Vector4d x = stokes(1, 0), y = stokes(0, 1), p = stokes(h, h), m = stokes(h, -h);
  const Eigen::Vector4d r = stokes(h, C(0, -h)), l = stokes(h, C(0, h));
  MuellerMatrix M;
  M << 0.5 * (x + y), 0.5 * (x - y), 0.5 * (p - m), 0.5 * (r - l);
  return M;
}

TEST(Mueller, Malus) {
  for (const double degrees : {0.0, 10.0, 30.0, 45.0, 60.0, 90.0, 135.0}) {
    const double a = degrees * kRadPerDeg;
    const StokesVector light = StokesVector::linear(3.0, a, {});
    EXPECT_NEAR(apply(diattenuator(1.0, 0.0), light, Vec3::UnitX(), light.frame).I, 3.0 * std::cos(a) * std::cos(a),
                1e-14);
    EXPECT_NEAR((polarizer(a) * Eigen::Vector4d(1, 1, 0, 0))[0], std::cos(a) * std::cos(a), 1e-14);
  }
}

TEST(Mueller, ThreePolarizers) {
  const Eigen::Vector4d natural(1, 0, 0, 0);
  const double right_angle = 90.0 * kRadPerDeg;
  EXPECT_NEAR((polarizer(right_angle) * polarizer(0.0) * natural)[0], 0.0, 1e-15);
  EXPECT_NEAR((polarizer(right_angle) * polarizer(0.5 * right_angle) * polarizer(0.0) * natural)[0], 0.125, 1e-15);
}

TEST(Mueller, ApplyAsksForBothFrames) {
  const StokesVector light = StokesVector::linear(1.0, 0.0, {Vec3::UnitZ(), Vec3::UnitY()});
  const PolarizationFrame out{Vec3::UnitX(), Vec3::UnitZ()};
  const StokesVector got = apply(MuellerMatrix::Identity(), light, Vec3::UnitX(), out);
  EXPECT_NEAR(got.Q, -1.0, 1e-15);  // along y, which is -Q from x
  EXPECT_EQ(got.frame.k, out.k);
  EXPECT_EQ(got.frame.e1, out.e1);
}

TEST(Mueller, RotatorIsTheTurnOfTheAxes) {
  const double a = 0.4;
  const StokesVector s{1.0, 0.3, -0.5, 0.2, {}};
  const StokesVector turned = s.in_frame(Vec3(std::cos(a), std::sin(a), 0.0));
  const Eigen::Vector4d by_matrix = rotator(a) * Eigen::Vector4d(s.I, s.Q, s.U, s.V);
  EXPECT_NEAR((by_matrix - Eigen::Vector4d(turned.I, turned.Q, turned.U, turned.V)).norm(), 0.0, 1e-15);
}

TEST(Mueller, ElementsAreThoseOfTheirJonesMatrices) {
  using C = std::complex<double>;
  Eigen::Matrix2cd J = Eigen::Matrix2cd::Zero();
  J(0, 0) = std::sqrt(0.8);
  J(1, 1) = std::sqrt(0.1);
  EXPECT_NEAR((of_jones(J) - diattenuator(0.8, 0.1)).norm(), 0.0, 1e-14);
  const double r = 0.7;
  J(0, 0) = 1.0;
  J(1, 1) = std::exp(C(0, r));  // E2 lags
  EXPECT_NEAR((of_jones(J) - retarder(r)).norm(), 0.0, 1e-14);
  J << std::cos(r), std::sin(r), -std::sin(r), std::cos(r);
  EXPECT_NEAR((of_jones(J) - rotator(r)).norm(), 0.0, 1e-14);
}

TEST(Mueller, QuarterWavePlateMakesCircularLight) {
  const Eigen::Vector4d out = retarder(0.5 * kPi) * Eigen::Vector4d(1, 0, 1, 0);
  EXPECT_NEAR(out[2], 0.0, 1e-15);
  EXPECT_NEAR(out[3], -1.0, 1e-15);  // E2 -> i E2: left circular
}

TEST(Mueller, KappaAndDepolarizerTakeCoherence) {
  EXPECT_NEAR(diattenuator(0.9, 0.4, 0.5)(2, 2), 0.5 * 0.6, 1e-15);
  EXPECT_NEAR((depolarizer(0.25) * Eigen::Vector4d(1, 0.4, 0.4, 0.8) - Eigen::Vector4d(1, 0.3, 0.3, 0.6)).norm(), 0.0,
              1e-15);
}

TEST(Mueller, SumsOfJonesMatricesArePhysical) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    MuellerMatrix sum = MuellerMatrix::Zero();
    for (int term = 0; term <= i % 4; ++term) {
      Eigen::Matrix2cd J;
      for (int e = 0; e < 4; ++e) J(e / 2, e % 2) = {normal(generator), normal(generator)};
      sum += of_jones(J);
    }
    EXPECT_GE(least_coherency_eigenvalue(sum), -1e-14);
    EXPECT_TRUE(is_physical(sum));
  }
}

TEST(Mueller, WhatNoElementCanDoIsRefused) {
  EXPECT_TRUE(is_physical(MuellerMatrix::Zero()));
  // The mirror image of a state without turning the field: the transpose of every coherency, no optical element does
  // it.
  MuellerMatrix M = MuellerMatrix::Identity();
  M(3, 3) = -1.0;
  EXPECT_NEAR(least_coherency_eigenvalue(M), -0.5, 1e-14);
  EXPECT_FALSE(is_physical(M));
  // The film matrix as printed: c = sqrt(t_min), not sqrt(t_min t_max).
  M = diattenuator(0.5, 0.2);
  M(2, 2) = M(3, 3) = std::sqrt(0.2);
  EXPECT_FALSE(is_physical(M));
  EXPECT_FALSE(is_physical(-MuellerMatrix::Identity()));
  M = MuellerMatrix::Zero();
  M(1, 1) = 0.5;  // polarization out of nothing
  EXPECT_FALSE(is_physical(M));
  M(0, 0) = std::nan("");
  EXPECT_FALSE(is_physical(M));
}

}  // namespace
}  // namespace evenglow::core
