#include "tracer/microstructure/printed_dot.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/bumps.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/optics/opaque_reflector.h"

namespace evenglow::tests {
namespace {

using tracer::Side;

std::string plate_with(const std::string& dots, const std::string& face, const std::string& lit) {
  // An index next to 1 (R = 2.5e-9 a face) leaves nothing but the dots; the photon meets their face once.
  return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1, refractive_index: 1.0001}, microstructure: "
         "{face: " +
         face + ", cells: [4, 2], " + dots + "}, sources: [{kind: beam, face: " + lit +
         ", size_share: 1, gap_mm: 0.5}]";
}

/// Chance of a hit = density, from inside and from outside, on either face. False alarm 1e-3.
TEST(PrintedDot, IsMetWithTheOddsOfTheDensity) {
  for (const char* face : {"bottom", "top"}) {
    for (const char* lit : {"bottom", "top"}) {
      const Traced traced(plate_with("density: 0.3, reflectance: 0", face, lit), {40'000, 1, 10, 1});
      EXPECT_LT(std::abs(binomial_z(traced.absorbed("microstructure"), traced.photons(), 0.3)), z_limit(1e-3, 4))
          << face << lit;
      EXPECT_EQ(traced.accounted(), traced.photons());
    }
  }
}

TEST(PrintedDot, InkReflectsItsShare) {
  const Traced traced(plate_with("density: 1, reflectance: 0.8", "bottom", "bottom"), {40'000, 2, 10, 1});
  EXPECT_LT(std::abs(binomial_z(traced.absorbed("microstructure"), traced.photons(), 0.2)), two_sided_z(1e-3));
  EXPECT_EQ(traced.escaped(Side::kTop), 0.0);
  EXPECT_GT(traced.escaped(Side::kBottom), 0.79 * traced.photons());
}

TEST(PrintedDot, DefaultsAndFaults) {
  const tracer::BacklightSpec spec = backlight_of(plate_with("density: 0.3", "bottom", "top"));
  ASSERT_TRUE(spec.microstructure);
  EXPECT_EQ(spec.microstructure->shape.kind, "printed_dot");
  EXPECT_TRUE(spec.microstructure->shape.optics(1.49)->scatters());
  EXPECT_THROW(backlight_of(plate_with("reflectance: 1.5", "bottom", "top")), core::ConfigError);
}

/// Without the keys of later versions the dot is what it was: the same photons from the same seed.
TEST(PrintedDot, DefaultIsTheOpaqueReflector) {
  const auto dot = optics_of("kind: printed_dot", 1.5);
  const tracer::OpaqueReflector ink(0.95, 0.0);
  core::PhotonRng rng({3, 0, 0}, 0), same({3, 0, 0}, 0);
  const core::StokesVector light = core::StokesVector::linear(1.0, 0.3, {});
  for (int i = 0; i < 1000; ++i) {
    const auto out = dot->sample(light, rng), expected = ink.sample(light, same);
    ASSERT_EQ(out.has_value(), expected.has_value());
    if (!out) continue;
    EXPECT_EQ(out->light.frame.k, expected->light.frame.k);
  }
}

/// `sample` against `evaluate` and `specular`: shares by outcome, from both sides; with etendue's 1/n^2 from inside.
TEST(PrintedDot, SharesOfATranslucentDot) {
  constexpr double kIndex = 1.5;
  constexpr int kPhotons = 100'000;
  const auto dot = optics_of("kind: printed_dot, reflectance: 0.6, specular_share: 0.25, transmittance: 0.3", kIndex);
  for (const bool inside : {true, false}) {
    const double passing = inside ? 0.3 / (kIndex * kIndex) : 0.3;
    const core::Vec3 k = travel(35.0, 20.0, inside);
    const core::StokesVector light = core::StokesVector::linear(1.0, 0.7, tracer::tangential_frame(k).frame);
    core::PhotonRng rng({4, inside ? 1u : 0u, 0}, 0);
    int absorbed = 0, mirrored = 0, scattered = 0, passed = 0;
    double cosines = 0.0;
    for (int i = 0; i < kPhotons; ++i) {
      const auto out = dot->sample(light, rng);
      if (!out) {
        ++absorbed;
        continue;
      }
      const core::Vec3& k_out = out->light.frame.k;
      if (out->specular) {
        ++mirrored;
        EXPECT_NEAR((k_out - core::Vec3(k.x(), k.y(), -k.z())).norm(), 0.0, 1e-15);
        EXPECT_NEAR(out->light.degree_of_polarization(), 1.0, 1e-12);
        continue;
      }
      EXPECT_TRUE(out->light.is_unpolarized());
      cosines += std::abs(k_out.z());
      ((k_out.z() > 0.0) == inside ? passed : scattered) += 1;
    }
    const double limit = z_limit(1e-3, 10);
    EXPECT_LT(std::abs(binomial_z(absorbed, kPhotons, 0.1)), limit);
    EXPECT_LT(std::abs(binomial_z(mirrored, kPhotons, 0.15)), limit);
    EXPECT_LT(std::abs(binomial_z(passed, kPhotons, passing)), limit);
    EXPECT_LT(std::abs(binomial_z(scattered, kPhotons, 0.75 - passing)), limit);
    // Lambertian: mean cosine 2/3, variance 1/18.
    const double lambertian = passed + scattered;
    EXPECT_LT(std::abs(cosines / lambertian - 2.0 / 3.0) / std::sqrt(1.0 / 18.0 / lambertian), limit);
    EXPECT_NEAR(dot->evaluate(light, core::Vec3(0, 0, inside ? 1 : -1)).I * core::kPi, passing, 1e-15);
    EXPECT_NEAR(dot->evaluate(light, core::Vec3(0, 0, inside ? -1 : 1)).I * core::kPi, 0.75 - passing, 1e-15);
    EXPECT_NEAR(dot->specular(k).reflection(0, 0), 0.15, 1e-15);
  }
}

/// What goes out at radiance n^2 inside is what comes in at radiance 1 outside.
TEST(PrintedDot, TranslucentDotKeepsTheThermalEquilibrium) {
  for (const double n : {1.0, 1.49, 2.2}) {
    const auto dot = optics_of("kind: printed_dot, reflectance: 0.4, transmittance: 0.6", n);
    const auto f = [&](bool from_inside, bool to_outside) {
      const core::Vec3 k(0.0, 0.0, from_inside ? 1.0 : -1.0);
      return dot->evaluate(core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)),
                           core::Vec3(0.0, 0.0, to_outside ? 1.0 : -1.0))
                 .I *
             core::kPi;
    };
    EXPECT_NEAR(n * n * f(true, true) + f(false, true), 1.0, 1e-14);
    EXPECT_NEAR(n * n * f(true, false) + f(false, false), n * n, 1e-14);
  }
}

TEST(PrintedDot, SharesMustNotExceedTheWhole) {
  using testing::HasSubstr;
  EXPECT_THAT(faults_of_shape("kind: printed_dot, transmittance: 0.2"),
              HasSubstr("microstructure.transmittance: must not exceed 0.05 with the reflectance 0.95, got 0.2"));
  EXPECT_THAT(faults_of_shape("kind: printed_dot, specular_share: 2"), HasSubstr("must lie in [0, 1], got 2"));
  EXPECT_EQ(faults_of_shape("kind: printed_dot, reflectance: 0.9, transmittance: 0.1, specular_share: 1"), "accepted");
}

}  // namespace
}  // namespace evenglow::tests
