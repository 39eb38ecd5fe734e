#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/films/lpp.h"
#include "tracer/optics/dielectric_face.h"

/// Beams through polarizers and sheets, traced, against Malus, Brewster and products of Mueller matrices. Counts are
/// binomial; seeds fixed; 40,000 photons a case; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr TraceSetup kSetup{40'000, 1, 10, 1};

std::string lpp(double axis_deg, const std::string& more = "k1: 1, k2: 0, reflectance: 0") {
  return "{kind: lpp, axis_deg: " + text_of(axis_deg) + ", " + more + "}";
}

std::string beam_through(const std::string& films, const std::string& beam) {
  return "size: {length_mm: 100, width_mm: 100}, films: [" + films + "], sources: [{kind: beam, face: bottom, " + beam +
         "}]";
}

double z_top(const std::string& films, const std::string& beam, double expected) {
  const Traced traced(beam_through(films, beam), kSetup);
  EXPECT_EQ(traced.accounted(), traced.photons());
  EXPECT_EQ(traced.lost(), 0.0);
  return std::abs(binomial_z(traced.escaped(Side::kTop), traced.photons(), expected));
}

TEST(ClosedFormPolarizers, Malus) {
  const double limit = z_limit(1e-3, 8);
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0, 130.0}) {
    const double c = std::cos(degrees * core::kRadPerDeg);
    EXPECT_LT(z_top(lpp(degrees), "polarization: linear, azimuth_deg: 0", degrees == 90.0 ? 0.0 : c * c), limit)
        << degrees;
  }
  EXPECT_LT(z_top(lpp(20), "polarization: none", 0.5), limit);
  EXPECT_LT(z_top(lpp(20), "polarization: circular", 0.5), limit);
}

TEST(ClosedFormPolarizers, ThreePolarizers) {
  const double limit = z_limit(1e-3, 3);
  EXPECT_LT(z_top(lpp(0) + ", " + lpp(45) + ", " + lpp(90), "polarization: none", 0.125), limit);
  EXPECT_LT(z_top(lpp(0) + ", " + lpp(45) + ", " + lpp(90), "polarization: linear", 0.25), limit);
  const Traced crossed(beam_through(lpp(0) + ", " + lpp(90), "polarization: none"), kSetup);
  EXPECT_EQ(crossed.escaped(Side::kTop), 0.0);
}

/// p light at Brewster's angle is not reflected at all; s light by the incoherent closed form 2 R / (1 + R).
TEST(ClosedFormPolarizers, BrewsterSheet) {
  const std::string angle = "angle_deg: " + text_of(std::atan(1.5) / core::kRadPerDeg) +
                            ", plane_deg: 30, polarization: linear, azimuth_deg: ";
  const std::string sheet = "{kind: sheet, refractive_index: 1.5}";
  const Traced p(beam_through(sheet, angle + "0"), kSetup);
  EXPECT_EQ(p.escaped(Side::kTop), p.photons());
  const double R = std::pow((1.5 * 1.5 - 1.0) / (1.5 * 1.5 + 1.0), 2);
  const Traced s(beam_through(sheet, angle + "90"), kSetup);
  EXPECT_LT(std::abs(binomial_z(s.escaped(Side::kBottom), s.photons(), 2.0 * R / (1.0 + R))), two_sided_z(1e-3));
}

/// A traced sheet turns and depolarizes light at 45 degrees by `incoherent_sheet`: transmitted, looked at through a
/// polarizer; reflected, through one that the light passes twice.
TEST(ClosedFormPolarizers, SheetAndPolarizerByMuellerMatrices) {
  const double limit = z_limit(1e-3, 12);
  for (const double angle : {0.0, 40.0, 70.0}) {
    const core::Vec3 k = travel(angle, 0.0, true), down(k.x(), k.y(), -k.z());
    const Bsdf::Specular sheet = incoherent_sheet(k.z(), 1.7, 0.5, 1.0);
    const std::string sheet_text = "{kind: sheet, refractive_index: 1.7, thickness_mm: 1, absorption_per_m: 500}";
    for (const double axis : {50.0, 120.0}) {
      const IdealPolarizer film = lpp_surface({1.0, 0.0, 0.0, axis * core::kRadPerDeg});
      const Eigen::Vector4d in(1.0, 0.0, 1.0, 0.0);  // azimuth 45, in the tangential count
      const std::string beam =
          "angle_deg: " + text_of(angle) + ", polarization: linear, azimuth_deg: 45, size_share: 0.1";
      const double through = (film.specular(k).transmission * sheet.transmission * in)[0];
      EXPECT_LT(z_top(sheet_text + ", " + lpp(axis), beam, through), limit) << angle << " " << axis;
      const double back = (film.specular(down).transmission * sheet.reflection * film.specular(k).transmission * in)[0];
      const Traced traced(beam_through(lpp(axis) + ", " + sheet_text, beam), kSetup);
      EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kBottom), traced.photons(), back)), limit)
          << angle << " " << axis;
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
