#include "core/light/fresnel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::core {
namespace {

double cos_deg(double degrees) {
  return std::cos(degrees * kRadPerDeg);
}

TEST(Fresnel, NormalIncidence) {
  const FresnelFace face = fresnel(1.0, 1.0, 1.5);
  EXPECT_NEAR(face.r_s.real(), -0.2, 1e-15);
  EXPECT_NEAR(face.r_p.real(), 0.2, 1e-15);  // r_p = -r_s here
  EXPECT_NEAR(face.t_s, 0.8, 1e-15);
  EXPECT_NEAR(face.t_p, 0.8, 1e-15);
  EXPECT_NEAR(face.transmitted_power, 1.5, 1e-15);
  EXPECT_NEAR(slab_reflectance_natural(1.0, 1.5), 2.0 * 0.04 / 1.04, 1e-15);
}

TEST(Fresnel, ReflectedAndTransmittedPowerSumToOne) {
  for (const auto& [n1, n2] : {std::pair{1.0, 1.5}, {1.5, 1.0}, {1.0, 1.0001}, {1.33, 2.4}}) {
    for (int degrees = 0; degrees < 90; ++degrees) {
      const FresnelFace face = fresnel(cos_deg(degrees), n1, n2);
      EXPECT_NEAR(face.reflectance_s() + face.t_s * face.t_s * face.transmitted_power, 1.0, 1e-13) << degrees;
      EXPECT_NEAR(face.reflectance_p() + face.t_p * face.t_p * face.transmitted_power, 1.0, 1e-13) << degrees;
    }
  }
}

/// Fresnel's own form: r_s = -sin(i - t) / sin(i + t), r_p = tan(i - t) / tan(i + t), with their signs.
TEST(Fresnel, SineAndTangentLaw) {
  for (const double n : {1.0001, 1.5, 1.0 / 1.5}) {
    for (double degrees = 2.0; degrees < 90.0; degrees += 4.0) {
      const double i = degrees * kRadPerDeg;
      if (std::sin(i) / n >= 1.0) break;
      const double t = std::asin(std::sin(i) / n);
      const FresnelFace face = fresnel(std::cos(i), 1.0, n);
      EXPECT_NEAR(face.r_s.real(), -std::sin(i - t) / std::sin(i + t), 1e-11) << n << " " << degrees;
      EXPECT_NEAR(face.r_p.real(), std::tan(i - t) / std::tan(i + t), 1e-11) << n << " " << degrees;
      EXPECT_EQ(face.r_s.imag(), 0.0);
      EXPECT_NEAR(face.cos_transmitted, std::cos(t), 1e-12);
    }
  }
}

TEST(Fresnel, BrewsterAngle) {
  const double brewster = std::atan(1.5);
  EXPECT_NEAR(fresnel(std::cos(brewster), 1.0, 1.5).r_p.real(), 0.0, 1e-15);
  EXPECT_GT(fresnel(std::cos(brewster - 0.01), 1.0, 1.5).r_p.real(), 0.0);
  EXPECT_LT(fresnel(std::cos(brewster + 0.01), 1.0, 1.5).r_p.real(), 0.0);
  const double n2 = 1.5 * 1.5;
  EXPECT_NEAR(fresnel(std::cos(brewster), 1.0, 1.5).reflectance_s(), std::pow((n2 - 1.0) / (n2 + 1.0), 2), 1e-14);
}

TEST(Fresnel, ReversedPathObeysTheStokesRelations) {
  for (double degrees = 0.0; degrees < 90.0; degrees += 5.0) {
    const FresnelFace in = fresnel(cos_deg(degrees), 1.0, 1.6);
    const FresnelFace out = fresnel(in.cos_transmitted, 1.6, 1.0);
    EXPECT_NEAR(out.r_s.real(), -in.r_s.real(), 1e-13);
    EXPECT_NEAR(out.r_p.real(), -in.r_p.real(), 1e-13);
    EXPECT_NEAR(in.t_s * out.t_s, 1.0 - in.reflectance_s(), 1e-13);
    EXPECT_NEAR(in.t_p * out.t_p, 1.0 - in.reflectance_p(), 1e-13);
  }
}

/// tan(d/2) = cos i sqrt(sin^2 i - n^2) / sin^2 i with d = arg r_s - arg r_p in [0, pi).
TEST(Fresnel, PhaseOfTotalReflection) {
  for (const double glass : {1.4938, 1.51, 2.0}) {
    const double n = 1.0 / glass;
    for (double degrees = 45.0; degrees < 90.0; degrees += 1.0) {
      const double i = degrees * kRadPerDeg;
      const FresnelFace face = fresnel(std::cos(i), glass, 1.0);
      ASSERT_TRUE(face.total_reflection);
      EXPECT_NEAR(std::abs(face.r_s), 1.0, 1e-14);
      EXPECT_NEAR(std::abs(face.r_p), 1.0, 1e-14);
      EXPECT_EQ(face.t_s, 0.0);
      const double d = std::arg(face.r_s * std::conj(face.r_p));
      const double expected =
          2.0 * std::atan(std::cos(i) * std::sqrt(std::sin(i) * std::sin(i) - n * n) / (std::sin(i) * std::sin(i)));
      EXPECT_NEAR(d, expected, 1e-9) << glass << " " << degrees;
      EXPECT_GE(d, 0.0);
    }
  }
}

TEST(Fresnel, CriticalAngle) {
  const double critical = std::asin(1.0 / 1.5);
  EXPECT_FALSE(fresnel(std::cos(critical - 1e-6), 1.5, 1.0).total_reflection);
  EXPECT_TRUE(fresnel(std::cos(critical + 1e-6), 1.5, 1.0).total_reflection);
}

TEST(Fresnel, GrazingIncidenceReflectsAllWithoutNaN) {
  const FresnelFace face = fresnel(0.0, 1.0, 1.5);
  EXPECT_EQ(face.reflectance_s(), 1.0);
  EXPECT_EQ(face.reflectance_p(), 1.0);
  EXPECT_EQ(face.transmitted_power, 0.0);
  EXPECT_NEAR(fresnel(0.3, 1.5, 1.5).reflectance_s(), 0.0, 1e-30);
}

}  // namespace
}  // namespace evenglow::core
