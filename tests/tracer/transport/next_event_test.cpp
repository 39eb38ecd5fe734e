#include "tracer/transport/next_event.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/light/fresnel.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string scene_text(const std::string& films_above, const std::string& receiver = "cells: [1, 1]") {
  return "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: "
         "[{kind: diffuser, transmittance: 0.6, reflectance: 0.3, lobe: lambertian, depolarization: 1}" +
         films_above + "], receivers: [{kind: luminance, " + receiver + "}]";
}

/// Two films against the sum over all reflections between them, written out order by order.
TEST(NextEvent, TransmissionHoldsAllOrders) {
  const Scene scene =
      scene_of(scene_text(", {kind: dbef, axis_deg: 20, transmittance_pass: 0.8, reflectance_pass: 0.15, "
                          "transmittance_block: 0.1, reflectance_block: 0.85}"
                          ", {kind: dbef, axis_deg: 65, transmittance_pass: 0.7, reflectance_pass: 0.2, "
                          "transmittance_block: 0.05, reflectance_block: 0.9}"));
  const NextEvent next_event(scene);
  for (const core::Vec3& k : {travel(0, 0, true), travel(30, 70, true), travel(65, 200, true)}) {
    const Bsdf& a = *scene.optics[0].viewed_films[0].surface;
    const Bsdf& b = *scene.optics[0].viewed_films[1].surface;
    const core::Vec3 down(k.x(), k.y(), -k.z());
    core::MuellerMatrix sum = core::MuellerMatrix::Zero(), between = a.specular(k).transmission;
    for (int order = 0; order < 400; ++order) {
      sum += b.specular(k).transmission * between;
      between = a.specular(down).reflection * b.specular(k).reflection * between;
    }
    EXPECT_NEAR((next_event.transmission(k, 0) - sum).norm(), 0.0, 1e-9);
  }
}

TEST(NextEvent, ThreeSheetsAgreeWithTheClosedForm) {
  const std::string sheet = ", {kind: sheet, refractive_index: 1.5}";
  const Scene scene = scene_of(scene_text(sheet + sheet + sheet));
  for (const double degrees : {0.0, 40.0, 75.0}) {
    const core::Vec3 k = travel(degrees, 20, true);
    const core::MuellerMatrix T = NextEvent(scene).transmission(k, 0);
    const core::FresnelFace face = core::fresnel(k.z(), 1.0, 1.5);
    const auto stack = [](double R) { return (1.0 - R) / (1.0 + 5.0 * R); };  // 2 N - 1 = 5
    EXPECT_NEAR(T(0, 0) + T(0, 1), stack(face.reflectance_p()), 1e-12);
    EXPECT_NEAR(T(0, 0) - T(0, 1), stack(face.reflectance_s()), 1e-12);
  }
}

/// A Lambertian scatterer: every score is T / pi times what the films above let through at its direction.
TEST(NextEvent, ScoreOfALambertianScatterer) {
  const Scene bare = scene_of(scene_text(""));
  const Scene covered = scene_of(scene_text(", {kind: lpp, k1: 0.8, k2: 0.02, reflectance: 0.05}"));
  core::PhotonRng rng({1, 0, 0}, 0);
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(travel(50, 0, true)));
  for (int i = 0; i < 100; ++i) {
    const auto score = NextEvent(bare).score(*bare.spec.films[0].surface, light, {10, 5, 0.05}, 0, rng);
    ASSERT_TRUE(score);
    EXPECT_NEAR(score->weight, 0.6 / core::kPi, 1e-14);
    EXPECT_EQ(score->bin, 0U);
    const auto through = NextEvent(covered).score(*covered.spec.films[0].surface, light, {10, 5, 0.05}, 0, rng);
    EXPECT_NEAR(through->weight, 0.6 * 0.41 / core::kPi, 1e-14);
  }
}

TEST(NextEvent, OutsideTheActiveAreaNothingIsScored) {
  const Scene scene = scene_of(scene_text("", "cells: [2, 1], margins: {left_mm: 5}"));
  core::PhotonRng rng({1, 0, 0}, 0);
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(travel(50, 0, true)));
  const auto at = [&](double x) {
    return NextEvent(scene).score(*scene.spec.films[0].surface, light, {x, 5, 0.05}, 0, rng);
  };
  EXPECT_FALSE(at(4.9));
  EXPECT_EQ(at(6.0)->bin, 0U);
  EXPECT_EQ(at(19.0)->bin, 1U);
}

/// A thick sheet shifts what is seen through it: at the angle t, x + d tan t' (tan t' the refracted angle). The mean
/// bin over a wide cone is known from the optics alone.
TEST(NextEvent, SheetsShiftThePlaceThatIsSeen) {
  const Scene scene = scene_of(scene_text(", {kind: sheet, refractive_index: 1.5, thickness_mm: 3, gap_mm: 1}",
                                          "cells: [200, 100], cone_deg: 60"));
  core::PhotonRng rng({20260101, 0, 0}, 0);
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(travel(50, 0, true)));
  double got = 0.0, got_squares = 0.0;
  constexpr int kSamples = 50000;
  for (int i = 0; i < kSamples; ++i) {
    const auto score = NextEvent(scene).score(*scene.spec.films[0].surface, light, {10.05, 5.05, 0.05}, 0, rng);
    ASSERT_TRUE(score);
    const int ix = static_cast<int>(score->bin) % 200, iy = static_cast<int>(score->bin) / 200;
    const double r2 = std::pow(ix * 0.1 - 10.0, 2) + std::pow(iy * 0.1 - 5.0, 2);
    got += r2;
    got_squares += r2 * r2;
  }
  // sin^2 t is uniform up to sin^2 60; the path is 1 mm of air (the gap) and 3 mm of glass.
  double expected = 0.0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double s2 = 0.75 * (i + 0.5) / kSteps, s = std::sqrt(s2);
    const double way = s / std::sqrt(1.0 - s2) + 3.0 * s / std::sqrt(2.25 - s2);
    expected += way * way / kSteps;
  }
  const double mean = got / kSamples;
  const double se = std::sqrt((got_squares / kSamples - mean * mean) / kSamples);
  EXPECT_LT(std::abs(z_score({mean, se}, expected + 2.0 * 0.01 / 12.0)),
            two_sided_z(1e-3));  // and the cells' own width
}

}  // namespace
}  // namespace evenglow::tests
