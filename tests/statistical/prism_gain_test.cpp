#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/films/bef.h"

/// On-axis gain of prism films over an endless Lambertian cavity of reflectance rho. With R the share of Lambertian
/// natural light from below that the films return, and T(cone) the share of natural light within the cone from above
/// that they pass (the reversed path), the radiance below them is 1 / (1 - rho R) of that without films, and
///     gain = T(cone) / (1 - rho R),   share that leaves = (1 - R) / (1 - rho R).
/// Seeds are fixed; the chance of a false alarm is 1e-4 for each test.
namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
using tracer::PrismFilm;

PrismFilm film(double axis) {
  tracer::PrismFilmSpec spec;
  spec.axis = axis;
  return PrismFilm(spec);
}

/// Films above each other, clear: light goes to and fro between them until it leaves.
bool leaves_above(const std::vector<PrismFilm>& films, const Vec3& k, core::PhotonRng& rng) {
  StokesVector light = StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
  int at = k.z() > 0.0 ? 0 : static_cast<int>(films.size()) - 1;
  while (at >= 0 && at < static_cast<int>(films.size())) {
    light = *films[static_cast<std::size_t>(at)].trace(light, rng).light;
    at += light.frame.k.z() > 0.0 ? 1 : -1;
  }
  return at > 0;
}

core::Estimate share(int hits, int trials) {
  const double p = static_cast<double>(hits) / trials;
  return {p, std::sqrt(p * (1.0 - p) / trials)};
}

struct Stack {
  core::Estimate returned;  ///< R
  core::Estimate passed;    ///< T(cone)

  Stack(const std::vector<PrismFilm>& films, double cone_deg, int photons) {
    core::PhotonRng rng({30, 0, 0}, films.size());
    const double sin_cone = std::sin(cone_deg * core::kRadPerDeg);
    int below = 0, through = 0;
    for (int i = 0; i < photons; ++i) {
      below += !leaves_above(films, core::sample_lambertian(rng.uniform(), rng.uniform()), rng);
      const Vec3 view = core::sample_cosine_cone(rng.uniform(), rng.uniform(), sin_cone);
      through += !leaves_above(films, Vec3(view.x(), view.y(), -view.z()), rng);
    }
    returned = share(below, photons);
    passed = share(through, photons);
  }
  core::Estimate gain(double rho) const {
    const double left = 1.0 - rho * returned.value;
    const double value = passed.value / left;
    return {value, value * std::hypot(passed.se / passed.value, rho * returned.se / left)};
  }
  core::Estimate leaving(double rho) const {
    const double left = 1.0 - rho * returned.value;
    return {(1.0 - returned.value) / left, (1.0 - rho) / (left * left) * returned.se};
  }
};

Traced cavity(double rho, const std::string& films, std::uint64_t photons) {
  return Traced(std::string(kMirrorRoom) + ", bottom: {kind: white, gap_mm: 0.001, reflectance: " + text_of(rho) +
                    "}}, sources: [{kind: lambertian_face, face: bottom}], films: [" + films +
                    "], receivers: [{kind: luminance, cells: [1, 1], cone_deg: 10, estimator: counting}]",
                {photons});
}

double z_of(const core::Estimate& a, const core::Estimate& b) {
  return std::abs(a.value - b.value) / std::hypot(a.se, b.se);
}

void expect_closed_form(const Stack& stack, const std::string& films, double rho, double limit) {
  const std::uint64_t photons = 200'000;
  const Traced with = cavity(rho, films, photons);
  const core::Estimate a = with.mean_luminance();
  // Without films the source itself is seen: its flux over pi and the area of the room.
  const double bare = 100.0 / (core::kPi * 2000.0 * 1000.0) * core::kCandelaPerM2;
  EXPECT_LT(z_of({a.value / bare, a.se / bare}, stack.gain(rho)), limit) << films << " rho " << rho;
  const core::Estimate out = share(static_cast<int>(with.escaped(tracer::Side::kTop)), static_cast<int>(photons));
  EXPECT_LT(z_of(out, stack.leaving(rho)), limit) << films << " rho " << rho;
  EXPECT_EQ(with.lost(), 0.0);
  EXPECT_EQ(with.absorbed("films"), 0.0);
}

TEST(PrismGain, TracedCavityMeetsTheClosedForm) {
  const double limit = z_limit(1e-4, 8);
  const Stack one({film(0.0)}, 10.0, 200'000);
  const Stack crossed({film(0.0), film(core::kPi / 2)}, 10.0, 200'000);
  for (const double rho : {0.75, 0.95}) {
    expect_closed_form(one, "{kind: bef}", rho, limit);
    expect_closed_form(crossed, "{kind: bef}, {kind: bef, axis_deg: 90}", rho, limit);
  }
}

TEST(PrismGain, OnAxisGainOfRealBacklights) {
  // Published gains are about 1.6 for one film and 2.2 for a crossed pair. Both belong to one share of returned light
  // that comes back, near 0.75; a white sheet of 0.98 with nothing else around it gives more, up to 1 / (1 - R).
  const Stack one({film(0.0)}, 2.0, 200'000);
  const Stack crossed({film(0.0), film(core::kPi / 2)}, 2.0, 200'000);
  for (const double rho : {0.72, 0.75, 0.78}) {
    EXPECT_GT(one.gain(rho).value, 1.5) << rho;
    EXPECT_LT(one.gain(rho).value, 1.75) << rho;
    EXPECT_GT(crossed.gain(rho).value, 2.0) << rho;
    EXPECT_LT(crossed.gain(rho).value, 2.4) << rho;
  }
  EXPECT_NEAR(one.gain(0.98).value, 2.01, 0.02);
  EXPECT_LT(one.gain(1.0).value, 1.0 / (1.0 - one.returned.value));
  std::printf("R %.4f T(2 deg) %.4f; crossed R %.4f T %.4f\n", one.returned.value, one.passed.value,
              crossed.returned.value, crossed.passed.value);
  for (const double rho : {0.70, 0.75, 0.80, 0.90, 0.98, 1.0}) {
    std::printf("rho %.2f: one %.3f, crossed %.3f\n", rho, one.gain(rho).value, crossed.gain(rho).value);
  }
}

}  // namespace
}  // namespace evenglow::tests
