#include "tracer/optics/dielectric_face.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/light/fresnel.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"

/// Statistical tests: seed fixed, false alarm 1e-3 for each test.
namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;
using tests::travel;
constexpr double kRad = core::kRadPerDeg;

/// Frame of the face: e1 = p, e2 = s with s = z x h, as in core/light/fresnel.h.
core::PolarizationFrame face_frame(const Vec3& k) {
  const Vec3 h = Vec3(k.x(), k.y(), 0.0).normalized();
  return core::PolarizationFrame::with_e2(k, Vec3::UnitZ().cross(h));
}

StokesVector in_face_frame(const StokesVector& light) {
  return light.in_frame(face_frame(light.frame.k).e1);
}

/// Two total reflections at 54.6 degrees in glass of 1.51 turn linear light at 45 degrees into circular light.
TEST(DielectricFace, FresnelRhomb) {
  core::PhotonRng rng({1, 0, 0}, 0);
  for (const double azimuth : {0.0, 33.0, 250.0}) {
    const Vec3 k = travel(54.6, azimuth, true);
    for (const double sign : {1.0, -1.0}) {
      const StokesVector in = StokesVector::linear(1.0, sign * 45.0 * kRad, face_frame(k));
      const auto once = DielectricFace(1.51, 1.0).sample(in, rng);
      ASSERT_TRUE(once && once->light.frame.k.z() < 0.0);
      EXPECT_NEAR(in_face_frame(once->light).V, -sign * std::sqrt(0.5), 0.01);
      const auto twice = DielectricFace(1.0, 1.51).sample(once->light, rng);
      ASSERT_TRUE(twice && twice->light.frame.k.z() > 0.0);
      // U + iV -> exp(-2 i d) (U + iV) with d = 45 degrees: left circular.
      EXPECT_NEAR(twice->light.V, -sign, 2e-4);
      EXPECT_NEAR(twice->light.degree_of_polarization(), 1.0, 1e-12);
      EXPECT_NEAR((twice->light.frame.k - k).norm(), 0.0, 1e-14);
    }
  }
}

TEST(DielectricFace, TotalReflectionTurnsThePhaseByTheFormula) {
  core::PhotonRng rng({1, 0, 0}, 0);
  const double n = 1.0 / 1.4938;
  for (const double degrees : {43.0, 50.0, 60.0, 75.0, 89.0}) {
    const double i = degrees * kRad;
    const double half =
        std::atan(std::cos(i) * std::sqrt(std::sin(i) * std::sin(i) - n * n) / (std::sin(i) * std::sin(i)));
    const Vec3 k = travel(degrees, 20.0, true);
    const auto out = DielectricFace(1.4938, 1.0).sample(StokesVector::linear(1.0, 45.0 * kRad, face_frame(k)), rng);
    ASSERT_TRUE(out);
    const StokesVector light = in_face_frame(out->light);
    EXPECT_NEAR(light.Q, 0.0, 1e-12);
    EXPECT_NEAR(light.U, std::cos(2.0 * half), 1e-12);
    EXPECT_NEAR(light.V, -std::sin(2.0 * half), 1e-12);
  }
}

/// +45 stays +45 through a face that is hardly there, from both sides; |r_p| in place of r_p would turn it.
TEST(DielectricFace, FaintFaceKeepsTheFieldInTransmission) {
  core::PhotonRng rng({1, 0, 0}, 0);
  for (const bool up : {false, true}) {
    for (const double degrees : {0.0, 30.0, 56.0, 70.0}) {
      const Vec3 k = travel(degrees, 130.0, up);
      const core::PolarizationFrame frame = tangential_frame(k).frame;
      const auto out = DielectricFace(1.0, 1.0001).sample(StokesVector::linear(1.0, 45.0 * kRad, frame), rng);
      ASSERT_TRUE(out && out->light.frame.k.z() * k.z() > 0.0);
      const StokesVector light = out->light.in_frame(tangential_frame(out->light.frame.k).frame.e1);
      EXPECT_NEAR(light.U, 1.0, 1e-5) << up << " " << degrees;
      EXPECT_NEAR((out->light.frame.k - k).norm(), 0.0, 1e-3);
    }
  }
}

/// Reflected +45 light, counted in p and s: U = 2 r_p r_s, so its sign changes at Brewster's angle.
TEST(DielectricFace, ReflectionHasTheSignOfBothAmplitudes) {
  core::PhotonRng rng({3, 0, 0}, 0);
  for (const double degrees : {10.0, 40.0, 70.0, 85.0}) {
    const Vec3 k = travel(degrees, 0.0);
    const core::FresnelFace face = core::fresnel(std::cos(degrees * kRad), 1.0, 1.5);
    const double rp = face.r_p.real(), rs = face.r_s.real();
    for (int i = 0; i < 2000; ++i) {
      const auto out = DielectricFace(1.5, 1.0).sample(StokesVector::linear(1.0, 45.0 * kRad, face_frame(k)), rng);
      ASSERT_TRUE(out);
      if (out->light.frame.k.z() < 0.0) continue;
      const StokesVector light = in_face_frame(out->light);
      EXPECT_NEAR(light.U, 2.0 * rp * rs / (rp * rp + rs * rs), 1e-12);
      EXPECT_NEAR(light.Q, (rp * rp - rs * rs) / (rp * rp + rs * rs), 1e-12);
      break;
    }
  }
  EXPECT_LT(core::fresnel(std::cos(10.0 * kRad), 1.0, 1.5).r_p.real() *
                core::fresnel(std::cos(10.0 * kRad), 1.0, 1.5).r_s.real(),
            0.0);
}

/// Odds of reflection and the states that leave: `sample` against `specular`, for all kinds of light, both sides,
/// with and without total reflection.
TEST(DielectricFace, SampleFollowsItsMatrices) {
  const DielectricFace face(1.5, 1.0);
  constexpr int kSamples = 20000;
  const double angles[] = {0.0, 25.0, 41.0, 60.0, 80.0};
  const double limit = tests::z_limit(1e-3, 2 * 5 * 5);
  std::uint32_t stream = 0;
  for (const bool up : {false, true}) {
    for (const double degrees : angles) {
      const Vec3 k = travel(degrees, 77.0, up);
      const Bsdf::Specular split = face.specular(k);
      for (const StokesVector& light : tests::test_lights(k)) {
        const Eigen::Vector4d s = to_film(light, tangential_frame(k));
        const Eigen::Vector4d reflected = split.reflection * s, transmitted = split.transmission * s;
        EXPECT_NEAR(reflected[0] + transmitted[0], 1.0, 1e-12);
        core::PhotonRng rng({20260101, stream++, 0}, 0);
        int count = 0;
        for (int i = 0; i < kSamples; ++i) {
          const auto out = face.sample(light, rng);
          ASSERT_TRUE(out && out->specular);
          const bool back = out->light.frame.k.z() * k.z() < 0.0;
          count += back ? 1 : 0;
          const Eigen::Vector4d expected = back ? reflected : transmitted;
          const Eigen::Vector4d got = to_film(out->light, tangential_frame(out->light.frame.k));
          ASSERT_NEAR((got - expected / expected[0]).norm(), 0.0, 1e-9) << degrees << " " << up << " " << back;
          ASSERT_NEAR(out->light.frame.k.norm(), 1.0, 1e-14);
        }
        EXPECT_LT(std::abs(tests::binomial_z(count, kSamples, std::min(1.0, reflected[0]))), limit)
            << degrees << " " << up;
      }
    }
  }
}

TEST(DielectricFace, SnellAndPhysicalMatrices) {
  core::PhotonRng rng({4, 0, 0}, 0);
  const DielectricFace face(1.6, 1.2);
  for (const bool up : {false, true}) {
    for (double degrees = 0.0; degrees < 90.0; degrees += 6.0) {
      const Vec3 k = travel(degrees, 10.0, up);
      const Bsdf::Specular split = face.specular(k);
      EXPECT_TRUE(core::is_physical(split.reflection, 1e-9));
      EXPECT_TRUE(core::is_physical(split.transmission, 1e-9));
      for (int i = 0; i < 50; ++i) {
        const auto out = face.sample(StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng);
        ASSERT_TRUE(out);
        const Vec3& k2 = out->light.frame.k;
        const double bend = k2.z() * k.z() < 0.0 ? 1.0 : (up ? 1.6 / 1.2 : 1.2 / 1.6);
        EXPECT_NEAR(k2.x(), bend * k.x(), 1e-12);
        EXPECT_NEAR(k2.y(), bend * k.y(), 1e-12);
      }
    }
  }
}

/// The sheet's matrices against a sum of all orders, written out with amplitudes; p and s apart, U and V too.
TEST(IncoherentSheet, IsTheSumOfItsOrders) {
  for (const double degrees : {0.0, 30.0, 56.3, 80.0}) {
    for (const double absorption : {0.0, 0.7}) {
      const double c = std::cos(degrees * kRad);
      const core::FresnelFace in = core::fresnel(c, 1.0, 1.5), out = core::fresnel(in.cos_transmitted, 1.5, 1.0);
      const double a = std::exp(-absorption * 0.4 / in.cos_transmitted);
      // Jones amplitudes (p, s) of each order in the tangential count, where reflection is (-r_p, r_s).
      core::MuellerMatrix T = core::MuellerMatrix::Zero(), R = T;
      const auto add = [](core::MuellerMatrix& M, double p, double s, double power) {
        M(0, 0) += 0.5 * (p * p + s * s) * power;
        M(0, 1) += 0.5 * (p * p - s * s) * power;
        M(2, 2) += p * s * power;
      };
      add(R, -in.r_p.real(), in.r_s.real(), 1.0);
      double p = in.t_p, s = in.t_s, power = in.transmitted_power * a;
      for (int order = 0; order < 200; ++order) {
        core::MuellerMatrix& M = order % 2 == 0 ? T : R;
        add(M, p * out.t_p, s * out.t_s, power * out.transmitted_power);
        p *= -out.r_p.real();
        s *= out.r_s.real();
        power *= a;
      }
      const Bsdf::Specular sheet = incoherent_sheet(c, 1.5, absorption, 0.4);
      for (const auto& [got, sum] : {std::pair{sheet.transmission, T}, {sheet.reflection, R}}) {
        EXPECT_NEAR(got(0, 0), sum(0, 0), 1e-12) << degrees;
        EXPECT_NEAR(got(1, 1), sum(0, 0), 1e-12);
        EXPECT_NEAR(got(0, 1), sum(0, 1), 1e-12);
        EXPECT_NEAR(got(1, 0), sum(0, 1), 1e-12);
        EXPECT_NEAR(got(2, 2), sum(2, 2), 1e-12);
        EXPECT_NEAR(got(3, 3), sum(2, 2), 1e-12);
        EXPECT_TRUE(core::is_physical(got, 1e-9));
      }
      if (absorption == 0.0) {
        EXPECT_NEAR(sheet.transmission(0, 0) + sheet.reflection(0, 0), 1.0, 1e-12);
        EXPECT_NEAR(sheet.reflection(0, 0), core::slab_reflectance_natural(c, 1.5), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer
