#include "tracer/films/wave_plate.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"
#include "tests/support/specular_checks.h"
#include "tracer/films/lpp.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::passed;
using tests::travel;

WavePlate plate(double retardance, double fast_axis, double spread = 0.0) {
  return WavePlate({.retardance = retardance, .spread = spread, .fast_axis = fast_axis});
}

/// Linear light whose field makes `degrees` with x, counted towards y, in a right-handed frame of its own.
core::StokesVector linear_from_x(const core::Vec3& k, double degrees) {
  const core::PolarizationFrame frame{k, core::Vec3(std::cos(degrees * kRad), std::sin(degrees * kRad), 0)};
  return core::StokesVector::linear(1, 0, frame);
}

/// Fast axis x, field at +45 from x towards y for light that travels up: E2 lags by a quarter, E2 = i E1, which is left
/// circular (docs/conventions.md: right is E2 = -i E1). For light that travels down the same field lies at -45 in its
/// right-handed frame, so it comes out right circular.
TEST(WavePlate, QuarterWaveMakesCircularLight) {
  const auto film = plate(0.5 * core::kPi, 0.0);
  EXPECT_NEAR(passed(film, linear_from_x(travel(0, 0, true), 45)).V, -1.0, 1e-12);
  EXPECT_NEAR(passed(film, linear_from_x(travel(0, 0, true), -45)).V, 1.0, 1e-12);
  EXPECT_NEAR(passed(film, linear_from_x(travel(0, 0, false), 45)).V, 1.0, 1e-12);
  EXPECT_NEAR(passed(film, linear_from_x(travel(0, 0, false), -45)).V, -1.0, 1e-12);
}

TEST(WavePlate, HalfWaveMirrorsTheAzimuthAndTheHand) {
  const auto film = plate(core::kPi, 25 * kRad);
  for (const bool up : {false, true}) {
    const core::Vec3 k = travel(0, 0, up);
    for (const double a : {0.0, 10.0, 25.0, 80.0, 140.0}) {
      const auto out = passed(film, linear_from_x(k, a));
      const auto expected = linear_from_x(k, 50.0 - a).in_frame(out.frame.e1);
      EXPECT_NEAR(out.Q, expected.Q, 1e-12);
      EXPECT_NEAR(out.U, expected.U, 1e-12);
    }
    const core::StokesVector right{1, 0, 0, 1, tangential_frame(k).frame};
    EXPECT_NEAR(passed(film, right).V, -1.0, 1e-12);
  }
}

/// Polarizer, quarter wave at 45 degrees, mirror: nothing comes back through the polarizer; without the plate all does.
TEST(WavePlate, Isolator) {
  const core::Vec3 up = travel(0, 0, true), down = travel(0, 0, false);
  const auto polarizer = lpp_surface({1.0, 0.0, 0.0, 0.3});
  const auto mirror = core::MuellerMatrix::Identity();  // in the tangential count
  for (const double turn : {0.25 * core::kPi, -0.25 * core::kPi}) {
    const auto film = plate(0.5 * core::kPi, 0.3 + turn);
    const core::MuellerMatrix there_and_back = polarizer.specular(down).transmission *
                                               film.specular(down).transmission * mirror *
                                               film.specular(up).transmission * polarizer.specular(up).transmission;
    EXPECT_NEAR(there_and_back.cwiseAbs().maxCoeff(), 0.0, 1e-15);
  }
  const core::MuellerMatrix bare = polarizer.specular(down).transmission * mirror * polarizer.specular(up).transmission;
  EXPECT_NEAR(bare(0, 0), 0.5, 1e-15);
}

/// The two waves by their wave vectors: both dispersion relations hold for (s cos, s sin, k_z), and the retardance is
/// the difference of the k_z. Solved by bisection, not by the formula of the header.
TEST(WavePlate, RetardanceOfObliqueRaysFromTheIndexEllipsoid) {
  const auto root = [](auto&& f) {
    double low = 0.0, high = 4.0;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (f(middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  for (const double dn : {0.1, 0.003, -0.05}) {
    const double no = 1.55, ne = no + dn;
    const WavePlate film({.retardance = 1.0, .fast_axis = 0.4, .index = no, .birefringence = dn});
    const double optic = dn > 0 ? 0.4 + 0.5 * core::kPi : 0.4;
    for (const double sigma : {0.0, 30.0, 60.0, 85.0}) {
      for (const double azimuth : {0.0, 35.0, 112.0, 270.0}) {
        const core::Vec3 k = travel(sigma, azimuth, true);
        const double along = k.x() * std::cos(optic) + k.y() * std::sin(optic);
        const double s2 = k.x() * k.x() + k.y() * k.y();
        const double kz_o = root([&](double z) { return (s2 + z * z) / (no * no) - 1.0; });
        const double kz_e =
            root([&](double z) { return along * along / (no * no) + (s2 + z * z - along * along) / (ne * ne) - 1.0; });
        EXPECT_NEAR(film.retardance_factor(tangential_frame(k)), (kz_e - kz_o) / dn, 1e-9)
            << dn << " " << sigma << " " << azimuth;
      }
    }
  }
}

/// The eigenstates: light of the ordinary wave (field across ray and optic axis) passes unchanged, and the signs of the
/// retardance along and across the optic axis are those of slow and fast.
TEST(WavePlate, EigenstatesOfObliqueRays) {
  for (const double dn : {0.003, -0.003}) {
    const WavePlate film({.retardance = 1.0, .fast_axis = 0.4, .index = 1.5, .birefringence = dn});
    const double optic = dn > 0 ? 0.4 + 0.5 * core::kPi : 0.4;
    const core::Vec3 c(std::cos(optic), std::sin(optic), 0);
    for (const bool up : {true, false}) {
      const core::Vec3 k = travel(70, 100, up);
      const core::Vec3 inside =
          core::Vec3(k.x() / 1.5, k.y() / 1.5, std::copysign(std::sqrt(1 - k.head<2>().squaredNorm() / 2.25), k.z()));
      const core::Vec3 o = inside.cross(c).normalized();
      // Azimuth of the ordinary field in the tangential frames, inside as outside.
      const auto frame = tangential_frame(k), frame_inside = tangential_frame(inside);
      const core::Vec3 e1 = frame_inside.frame.e1, e2 = inside.cross(e1);
      const double azimuth = std::atan2(o.dot(e2), o.dot(e1));
      const auto light = core::StokesVector::linear(1, azimuth, frame.frame);
      const auto out = passed(film, light);
      EXPECT_NEAR(out.Q, light.Q, 1e-12);
      EXPECT_NEAR(out.U, light.U, 1e-12);
      // At 45 degrees from the ordinary field, the retardance of e behind o: V = -sin for o as e1.
      const auto diagonal = passed(film, core::StokesVector::linear(1, azimuth + 0.25 * core::kPi, frame.frame));
      const double expected = film.retardance_factor(frame) * (dn > 0 ? 1.0 : -1.0);
      EXPECT_NEAR(diagonal.V, -std::sin(expected), 1e-12);
    }
  }
}

TEST(WavePlate, SpreadIsTheMeanOfPlates) {
  // Mean over the normal distribution by quadrature (trapezoid over +-8 standard deviations).
  const double mean = 7.2, spread = 0.8;
  core::MuellerMatrix sum = core::MuellerMatrix::Zero();
  double weight = 0.0;
  const core::Vec3 k = travel(40, 70, true);
  for (int i = -400; i <= 400; ++i) {
    const double x = 0.02 * i, w = std::exp(-0.5 * x * x);
    sum += w * plate(mean + spread * x, 0.3).specular(k).transmission;
    weight += w;
  }
  EXPECT_TRUE(plate(mean, 0.3, spread).specular(k).transmission.isApprox(sum / weight, 1e-9));
}

TEST(WavePlate, PassiveAndReciprocal) {
  for (const bool faces : {false, true}) {
    for (const double spread : {0.0, 1.0, 50.0}) {
      for (const double dn : {0.1, -0.1}) {
        const WavePlate film({1.9, spread, 0.7, 1.6, dn, faces});
        tests::expect_passive_and_reciprocal(film);
        for (const core::Vec3& k : tests::many_directions()) {
          const auto s = film.specular(k);
          EXPECT_NEAR(s.transmission(0, 0) + s.reflection(0, 0), 1.0, 1e-9);  // nothing is absorbed
          EXPECT_EQ(s.reflection.isZero(0.0), !faces);
        }
      }
    }
  }
}

TEST(WavePlate, RefusesWhatIsNone) {
  EXPECT_THROW(plate(-1.0, 0.0), core::Error);
  EXPECT_THROW(plate(1.0, 0.0, -1.0), core::Error);
  EXPECT_THROW(WavePlate({.index = 1.2, .birefringence = -0.25}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
