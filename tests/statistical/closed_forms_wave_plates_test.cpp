#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Beams through stacks of polarizers and wave plates, traced, against closed forms. Counts are binomial; seeds fixed;
/// false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr TraceSetup kSetup{40'000, 1, 10, 1};

const std::string kRoom = "size: {length_mm: 100, width_mm: 100}, ";

std::string lpp(double axis) {
  return "{kind: lpp, k1: 1, k2: 0, reflectance: 0, axis_deg: " + text_of(axis) + "}";
}
std::string plate(double axis, const std::string& keys) {
  return "{kind: retarder, axis_deg: " + text_of(axis) + ", " + keys + "}";
}

/// Share that leaves by the top, of a beam of natural light from below.
double top_share(const std::string& films) {
  const Traced traced(kRoom + "films: [" + films + "], sources: [{kind: beam, face: bottom}]", kSetup);
  EXPECT_EQ(traced.accounted(), traced.photons());
  return traced.escaped(Side::kTop) / traced.photons();
}

double z_top(const std::string& films, double expected) {
  return std::abs(z_score({top_share(films), std::sqrt(expected * (1.0 - expected) / 40'000)}, expected));
}

/// Polarizer at 0, plate at a, analyzer at b (Born & Wolf, 15.4.2):
/// I = 1/2 [cos^2 b - sin 2a sin 2(a - b) sin^2(delta / 2)].
TEST(ClosedFormWavePlates, BetweenPolarizers) {
  const double limit = z_limit(1e-3, 6);
  for (const double delta : {40.0, 90.0}) {
    for (const auto& [a, b] : {std::pair{45.0, 90.0}, {20.0, 90.0}, {30.0, 20.0}}) {
      const double ra = a * core::kRadPerDeg, rb = b * core::kRadPerDeg;
      const double expected =
          0.5 * (std::pow(std::cos(rb), 2) -
                 std::sin(2 * ra) * std::sin(2 * (ra - rb)) * std::pow(std::sin(0.5 * delta * core::kRadPerDeg), 2));
      EXPECT_LT(z_top(lpp(0) + ", " + plate(a, "retardance_deg: " + text_of(delta)) + ", " + lpp(b), expected), limit)
          << delta << " " << a << " " << b;
    }
  }
}

/// A half wave at 45 degrees opens crossed polarizers; two quarter waves are one half wave, crossed they are nothing.
TEST(ClosedFormWavePlates, PlatesAdd) {
  const std::string half = plate(45, "plate: half"), quarter = plate(45, "plate: quarter");
  EXPECT_LT(z_top(lpp(0) + ", " + half + ", " + lpp(90), 0.5), z_limit(1e-3, 2));
  EXPECT_LT(z_top(lpp(0) + ", " + quarter + ", " + quarter + ", " + lpp(90), 0.5), z_limit(1e-3, 2));
  EXPECT_EQ(top_share(lpp(0) + ", " + quarter + ", " + plate(135, "plate: quarter") + ", " + lpp(90)), 0.0);
}

/// Light from below through a polarizer and a quarter wave onto a mirror (an ideal reflective polarizer that refuses
/// both states) never comes back through the polarizer; without the plate it does.
TEST(ClosedFormWavePlates, Isolator) {
  const std::string mirror = "{kind: dbef, transmittance_pass: 0, reflectance_pass: 1, reflectance_block: 1}";
  const auto back = [&](const std::string& films) {
    const Traced traced(kRoom + "films: [" + films + "], sources: [{kind: beam, face: bottom}]", kSetup);
    return traced.escaped(Side::kBottom);
  };
  EXPECT_EQ(back(lpp(0) + ", " + plate(45, "plate: quarter") + ", " + mirror), 0.0);
  EXPECT_GT(back(lpp(0) + ", " + mirror), 19'000);
}

/// A cavity that keeps the polarization gains nothing from a reflective polarizer; a quarter wave below the film turns
/// what comes back from the mirror by 90 degrees, so that it passes the second time: 1/2 + eta / 2.
TEST(ClosedFormWavePlates, QuarterWaveRecyclesInAMirrorCavity) {
  const double eta = 0.8;
  const std::string room = std::string(kMirrorRoom) + ", bottom: {kind: mirror, reflectance: " + text_of(eta) + "}}, ";
  const std::string beam = "sources: [{kind: beam, face: bottom, gap_mm: 0.01, size_share: 0.1}]";
  const std::string dbef = "{kind: dbef, axis_deg: 0}";
  const auto share = [&](const std::string& films) {
    const Traced traced(room + "films: [" + films + "], " + beam, kSetup);
    return traced.escaped(Side::kTop) / traced.photons();
  };
  const auto z = [](double value, double p) { return std::abs(binomial_z(value * 40'000, 40'000, p)); };
  EXPECT_LT(z(share(dbef), 0.5), z_limit(1e-3, 2));
  EXPECT_LT(z(share(plate(45, "plate: quarter") + ", " + dbef), 0.5 + 0.5 * eta), z_limit(1e-3, 2));
}

/// A carrier of wide spread at 45 degrees to crossed polarizers: half of what passes the first passes the second.
TEST(ClosedFormWavePlates, CarrierDepolarizes) {
  const std::string carrier = "{kind: carrier, axis_deg: 45, faces: coated, retardance_spread_nm: 2000}";
  EXPECT_LT(z_top(lpp(0) + ", " + carrier + ", " + lpp(90), 0.25), two_sided_z(1e-3));
}

}  // namespace
}  // namespace evenglow::tests
