#include "core/light/stokes.h"

#include <cmath>
#include <complex>
#include <random>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::core {
namespace {

Vec3 random_direction(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  return Vec3(normal(generator), normal(generator), normal(generator)).normalized();
}

TEST(PolarizationFrame, AnyIsRightHandedForEveryDirection) {
  std::mt19937_64 generator(7);
  for (int i = 0; i < 1000; ++i) {
    Vec3 k = random_direction(generator);
    if (i < 6) k = Vec3::Unit(i / 2) * (i % 2 == 0 ? 1.0 : -1.0);
    const PolarizationFrame frame = PolarizationFrame::any(k);
    EXPECT_NEAR(frame.e1.norm(), 1.0, 1e-14);
    EXPECT_NEAR(frame.e1.dot(k), 0.0, 1e-14);
    EXPECT_NEAR((frame.e1.cross(frame.e2()) - k).norm(), 0.0, 1e-14);
  }
}

TEST(PolarizationFrame, WithE2HasThatAxis) {
  const Vec3 k = Vec3(0.3, -0.2, 0.6).normalized();
  const Vec3 s = k.cross(Vec3::UnitZ()).normalized();
  EXPECT_NEAR((PolarizationFrame::with_e2(k, s).e2() - s).norm(), 0.0, 1e-14);
}

TEST(StokesVector, LinearLightHasItsAngleTwice) {
  const PolarizationFrame frame;
  const StokesVector at45 = StokesVector::linear(2.0, 45.0 * kRadPerDeg, frame);
  EXPECT_NEAR(at45.Q, 0.0, 1e-15);
  EXPECT_NEAR(at45.U, 2.0, 1e-15);
  EXPECT_NEAR(StokesVector::linear(2.0, 90.0 * kRadPerDeg, frame).Q, -2.0, 1e-15);
  EXPECT_NEAR(at45.degree_of_polarization(), 1.0, 1e-15);
}

/// docs/conventions.md: I, Q, U + iV from complex amplitudes, of one field in two frames.
TEST(StokesVector, TurnsLikeTheFieldItself) {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  const auto of_field = [](std::complex<double> a, std::complex<double> b, const PolarizationFrame& frame) {
    const std::complex<double> uv = 2.0 * a * std::conj(b);
    return StokesVector{std::norm(a) + std::norm(b), std::norm(a) - std::norm(b), uv.real(), uv.imag(), frame};
  };
  for (int i = 0; i < 200; ++i) {
    const PolarizationFrame frame = PolarizationFrame::any(random_direction(generator));
    const std::complex<double> a(normal(generator), normal(generator));
    const std::complex<double> b(normal(generator), normal(generator));
    const double angle = normal(generator);
    const Vec3 e1 = std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2();
    const PolarizationFrame turned{frame.k, e1};
    const std::complex<double> a2 = a * frame.e1.dot(turned.e1) + b * frame.e2().dot(turned.e1);
    const std::complex<double> b2 = a * frame.e1.dot(turned.e2()) + b * frame.e2().dot(turned.e2());
    const StokesVector expected = of_field(a2, b2, turned);
    const StokesVector got = of_field(a, b, frame).in_frame(e1);
    EXPECT_NEAR(got.I, expected.I, 1e-12);
    EXPECT_NEAR(got.Q, expected.Q, 1e-12);
    EXPECT_NEAR(got.U, expected.U, 1e-12);
    EXPECT_NEAR(got.V, expected.V, 1e-12);
    EXPECT_NEAR((got.frame.e1 - e1).norm(), 0.0, 1e-15);
  }
}

/// Right circular: at a fixed place the field turns clockwise for an observer who looks towards the source, that is
/// from e1 towards -e2, since that observer sees e1 to the right and e2 up (e1 x e2 = k points at them).
TEST(StokesVector, PositiveVTurnsClockwiseForTheObserver) {
  const std::complex<double> e1(1.0, 0.0), e2(0.0, -1.0);
  EXPECT_GT((2.0 * e1 * std::conj(e2)).imag(), 0.0);
  const std::complex<double> later = std::exp(std::complex<double>(0.0, -0.1));  // exp(-i w t)
  EXPECT_GT((e1 * later).real(), 0.9);
  EXPECT_LT((e2 * later).real(), -0.09);
}

TEST(StokesVector, ScalesAllComponents) {
  const StokesVector s{1.0, 0.5, -0.25, 0.125, {}};
  const StokesVector t = s.scaled(4.0);
  EXPECT_EQ(t.I, 4.0);
  EXPECT_EQ(t.Q, 2.0);
  EXPECT_EQ(t.U, -1.0);
  EXPECT_EQ(t.V, 0.5);
  EXPECT_TRUE(StokesVector::unpolarized(3.0, {}).is_unpolarized());
  EXPECT_FALSE(s.is_unpolarized());
  EXPECT_EQ(StokesVector{}.degree_of_polarization(), 0.0);
}

TEST(StokesVector, LinearAndCircularPartsCountForTheDegreeOfPolarization) {
  EXPECT_DOUBLE_EQ((StokesVector{2.0, 0.0, 0.0, -2.0, {}}).degree_of_polarization(), 1.0);
  EXPECT_DOUBLE_EQ((StokesVector{1.0, 0.3, 0.0, 0.4, {}}).degree_of_polarization(), 0.5);
  EXPECT_DOUBLE_EQ((StokesVector{1.0, 0.0, 0.6, 0.0, {}}).degree_of_polarization(), 0.6);
}

}  // namespace
}  // namespace evenglow::core
