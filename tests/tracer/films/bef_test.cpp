#include "tracer/films/bef.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"

/// Closed forms of single passes. Seeds are fixed; statistical limits are z values of a false alarm in 1e-4 a test.
namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;
using tests::travel;

constexpr double kRad = core::kRadPerDeg;
constexpr double kIndex = 1.58;

StokesVector natural(const Vec3& k) {
  return StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
}

/// Light whose field lies along the grooves (share 1) or in the cross-section (share 0), for k in the cross-section.
StokesVector along_groove(const Vec3& k, bool along) {
  return StokesVector::linear(1.0, along ? 0.0 : core::kPi / 2, {k, Vec3::UnitX()});
}

/// Power transmittance of a face, from the angles alone (Fresnel's sine and tangent forms; not core/light/fresnel).
double transmittance(double i, double n1, double n2, bool s) {
  const double t = std::asin(n1 / n2 * std::sin(i));
  if (i == 0.0) return 1.0 - std::pow((n1 - n2) / (n1 + n2), 2);
  const double r = s ? std::sin(i - t) / std::sin(i + t) : std::tan(i - t) / std::tan(i + t);
  return 1.0 - r * r;
}

PrismFilm film_90() {
  return PrismFilm(PrismFilmSpec{});
}

TEST(PrismFilm, OfWhatKindItIs) {
  const PrismFilm film = film_90();
  const Vec3 k = travel(20, 70, true);
  EXPECT_TRUE(film.redirects());
  EXPECT_FALSE(film.scatters());
  EXPECT_EQ(film.evaluate(natural(k), travel(3, 4, true)).I, 0.0);
  EXPECT_TRUE(film.specular(k).transmission.isZero());
  EXPECT_TRUE(film.specular(k).reflection.isZero());
  core::PhotonRng rng({1, 0, 0}, 0);
  const auto sample = film.sample(natural(k).scaled(3.0), rng);
  ASSERT_TRUE(sample);
  EXPECT_TRUE(sample->specular);
  EXPECT_NEAR(sample->light.I, 3.0, 1e-12);
}

TEST(PrismFilm, NormalLightFromBelowComesBackWhole) {
  for (const double n : {1.4143, 1.49, 1.58, 1.7}) {
    PrismFilmSpec spec;
    spec.refractive_index = n;
    const PrismFilm film(spec);
    core::PhotonRng rng({1, 0, 0}, 0);
    for (int i = 0; i < 20'000; ++i) {
      const PrismPass pass = film.trace(natural(Vec3::UnitZ()), rng);
      ASSERT_TRUE(pass.light);
      ASSERT_NEAR(pass.light->frame.k.z(), -1.0, 1e-9) << n;
      ASSERT_EQ(pass.facets, pass.base_faces == 1 ? 0 : 2 * (pass.base_faces - 1));
    }
  }
  // An index below sqrt 2 does not hold it.
  PrismFilmSpec spec;
  spec.refractive_index = 1.40;
  const PrismFilm film(spec);
  core::PhotonRng rng({1, 0, 0}, 0);
  int up = 0;
  for (int i = 0; i < 20'000; ++i) up += film.trace(natural(Vec3::UnitZ()), rng).light->frame.k.z() > 0.0;
  EXPECT_GT(up, 1000);
}

TEST(PrismFilm, TwoTotalReflectionsTurnThePhase) {
  // Fresnel, 45 degrees: tan(d/2) = cos i sqrt(sin^2 i - 1/n^2) / sin^2 i, arg r_s = arg r_p + d at each of the two
  // facets; U + iV = 2 E_p conj(E_s) turns by -2d in frames with e2 = s along the groove before and after.
  const double d = 2.0 * std::atan(std::sqrt(0.5) * std::sqrt(0.5 - 1.0 / (kIndex * kIndex)) / 0.5);
  const std::complex<double> in(0.5, 0.6);
  const std::complex<double> out = in * std::polar(1.0, -2.0 * d);
  const StokesVector light{1.0, 0.3, in.real(), in.imag(),
                           core::PolarizationFrame::with_e2(Vec3::UnitZ(), Vec3::UnitX())};
  const PrismFilm film = film_90();
  core::PhotonRng rng({2, 0, 0}, 0);
  int seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const PrismPass pass = film.trace(light, rng);
    if (pass.facets != 2 || pass.base_faces != 2) continue;
    ++seen;
    const Vec3& k = pass.light->frame.k;
    const StokesVector s = pass.light->in_frame(core::PolarizationFrame::with_e2(k, Vec3::UnitX()).e1);
    ASSERT_NEAR(s.Q, 0.3, 1e-9);
    ASSERT_NEAR(s.U, out.real(), 1e-9);
    ASSERT_NEAR(s.V, out.imag(), 1e-9);
  }
  EXPECT_GT(seen, 500);
}

/// Angle of incidence in air, from below, at which light begins to pass the facet that leans its way. With f the
/// azimuth from the groove, t the angle in the film and c the critical angle, the facet at 45 degrees passes light if
///     sin f sin t + cos t > sqrt 2 cos c,  so  t > atan(sin f) - acos(sqrt 2 cos c / sqrt(1 + sin^2 f)).
double cut_off(double azimuth) {
  const double s = std::sin(azimuth);
  const double c = std::sqrt(2.0) * std::cos(std::asin(1.0 / kIndex));
  return std::asin(kIndex * std::sin(std::atan(s) - std::acos(c / std::sqrt(1.0 + s * s))));
}

TEST(PrismFilm, CutOffAngles) {
  EXPECT_NEAR(cut_off(90 * kRad) / kRad, 9.09, 0.01);  // 45 degrees less the critical angle of 39.27, outside the film
  const PrismFilm film = film_90();
  core::PhotonRng rng({3, 0, 0}, 0);
  for (const double azimuth : {90.0, 60.0, 30.0, 27.0}) {
    for (const double offset : {-0.02, 0.02}) {
      const double angle = cut_off(azimuth * kRad) / kRad + offset;
      int passed = 0;
      for (int i = 0; i < 20'000; ++i) {
        const PrismPass pass = film.trace(natural(travel(angle, azimuth, true)), rng);
        // One facet and no more, and up: the first one passed it.
        passed += pass.facets == 1 && pass.light->frame.k.z() > 0.0;
      }
      if (offset < 0.0) {
        EXPECT_EQ(passed, 0) << azimuth;
      } else {
        EXPECT_GT(passed, 100) << azimuth;
      }
    }
  }
  // Near the plane of the grooves (sin f < sqrt(2 cos^2 c - 1)) neither facet passes light of any angle at once.
  for (const double angle : {5.0, 30.0, 60.0, 85.0}) {
    for (int i = 0; i < 5000; ++i) {
      const PrismPass pass = film.trace(natural(travel(angle, 20.0, true)), rng);
      ASSERT_FALSE(pass.facets == 1 && pass.light->frame.k.z() > 0.0);
    }
  }
}

TEST(PrismFilm, FirstPassFollowsSnellAndFresnel) {
  const PrismFilm film = film_90();
  const int count = 100'000;
  const double limit = tests::z_limit(1e-4, 9);
  for (const double angle : {15.0, 30.0, 50.0}) {
    const double inner = std::asin(std::sin(angle * kRad) / kIndex);
    const double at_facet = 45 * kRad - inner;
    const double exit = 45 * kRad - std::asin(kIndex * std::sin(at_facet));
    // A plumb line in the prism leans by tan(inner): that facet catches (1 + tan) / 2 of the pitch first.
    const double caught = 0.5 * (1.0 + std::tan(inner));
    double expected[2];
    for (const bool s : {false, true}) {
      expected[s] = caught * transmittance(angle * kRad, 1.0, kIndex, s) * transmittance(at_facet, kIndex, 1.0, s);
    }
    const Vec3 k = travel(angle, 90.0, true);
    const StokesVector lights[] = {along_groove(k, false), along_groove(k, true), natural(k)};
    const double odds[] = {expected[0], expected[1], 0.5 * (expected[0] + expected[1])};
    for (int which = 0; which < 3; ++which) {
      core::PhotonRng rng({4, static_cast<std::uint32_t>(which), 0}, static_cast<std::uint64_t>(angle));
      int passed = 0;
      for (int i = 0; i < count; ++i) {
        const PrismPass pass = film.trace(lights[which], rng);
        if (pass.facets != 1 || pass.base_faces != 1 || pass.light->frame.k.z() < 0.0) continue;
        ++passed;
        ASSERT_NEAR(pass.light->frame.k.y(), std::sin(exit), 1e-9) << angle;
        ASSERT_NEAR(pass.light->frame.k.x(), 0.0, 1e-12);
      }
      EXPECT_LT(std::abs(tests::binomial_z(passed, count, odds[which])), limit) << angle << " light " << which;
    }
  }
}

TEST(PrismFilm, AbsorbsByThePath) {
  // Light that two facets send straight back has been twice through the base and one pitch through the prism; what the
  // flat face then returns goes the same way once more.
  PrismFilmSpec spec;
  spec.absorption = 2.0;
  const PrismFilm film(spec);
  const double T = transmittance(0.0, 1.0, kIndex, true);
  const double round = std::exp(-spec.absorption * (2.0 * spec.base + spec.profile.pitch));
  core::PhotonRng rng({5, 0, 0}, 0);
  const int count = 200'000;
  int back = 0, back_again = 0, absorbed = 0;
  for (int i = 0; i < count; ++i) {
    const PrismPass pass = film.trace(natural(Vec3::UnitZ()), rng);
    absorbed += !pass.light;
    back += pass.light && pass.base_faces == 2;
    back_again += pass.light && pass.base_faces == 3;
  }
  const double limit = tests::z_limit(1e-4, 3);
  EXPECT_LT(std::abs(tests::binomial_z(back, count, T * T * round)), limit);
  EXPECT_LT(std::abs(tests::binomial_z(back_again, count, T * T * (1.0 - T) * round * round)), limit);
  EXPECT_LT(std::abs(tests::binomial_z(absorbed, count, T * (1.0 - round) / (1.0 - (1.0 - T) * round))), limit);
}

/// The same random numbers through a turned film: turned light gives turned light, to rounding.
void expect_turned(const PrismFilm& plain, const PrismFilm& turned, const Eigen::Matrix3d& turn) {
  for (int i = 0; i < 2000; ++i) {
    core::PhotonRng start({6, 1, 0}, static_cast<std::uint64_t>(i));
    const Vec3 k = travel(80.0 * start.uniform(), 360.0 * start.uniform(), start.uniform() < 0.5);
    const auto lights = tests::test_lights(k);
    const StokesVector& light = lights[static_cast<std::size_t>(i) % lights.size()];
    StokesVector other = light;
    other.frame = {turn * light.frame.k, turn * light.frame.e1};
    core::PhotonRng a({6, 0, 0}, static_cast<std::uint64_t>(i)), b({6, 0, 0}, static_cast<std::uint64_t>(i));
    const PrismPass one = plain.trace(light, a), two = turned.trace(other, b);
    ASSERT_EQ(one.facets, two.facets);
    const Vec3 expected = turn * one.light->frame.k;
    ASSERT_LT((expected - two.light->frame.k).norm(), 1e-9);
    const StokesVector s = two.light->in_frame(turn * one.light->frame.e1);
    ASSERT_NEAR(s.Q, one.light->Q, 1e-7);
    ASSERT_NEAR(s.U, one.light->U, 1e-7);
    ASSERT_NEAR(s.V, one.light->V, 1e-7);
  }
}

TEST(PrismFilm, AxisTurnsTheGroovesFromXTowardsY) {
  PrismFilmSpec spec;
  const PrismFilm plain(spec);
  spec.axis = 35 * kRad;
  expect_turned(plain, PrismFilm(spec), Eigen::AngleAxisd(spec.axis, Vec3::UnitZ()).toRotationMatrix());
  // With the grooves along y, light in the xz plane is what the facets turn: none of it leaves that plane.
  spec.axis = 90 * kRad;
  const PrismFilm crossed(spec);
  core::PhotonRng rng({7, 0, 0}, 0);
  for (int i = 0; i < 1000; ++i)
    ASSERT_NEAR(crossed.trace(natural(travel(30, 0, true)), rng).light->frame.k.y(), 0, 1e-12);
}

TEST(PrismFilm, InvertedIsHalfATurnAboutTheGrooves) {
  PrismFilmSpec spec;
  const PrismFilm plain(spec);
  spec.inverted = true;
  expect_turned(plain, PrismFilm(spec), Eigen::AngleAxisd(core::kPi, Vec3::UnitX()).toRotationMatrix());
}

TEST(PrismFilm, TurningFilmTurnsGrazingLightToTheNormal) {
  // Half apex g: the first facet takes light at a angle a from the normal to 90 - g + r inside, sin r = sin(a - 90 +
  // g) / n; total reflection at the other one makes that 3 g - 90 - r, and the flat face refracts it.
  PrismFilmSpec spec;
  spec.profile.apex = 64 * kRad;
  spec.inverted = true;
  const PrismFilm film(spec);
  const double half = 0.5 * spec.profile.apex;
  for (const double angle : {60.0, 65.0, 70.0}) {
    const double first = angle * kRad - 90 * kRad + half;
    const double turned = 3.0 * half - 90 * kRad - std::asin(std::sin(first) / kIndex);
    const double exit = std::asin(kIndex * std::sin(turned));
    EXPECT_LT(std::abs(exit), 8 * kRad);
    core::PhotonRng rng({8, 0, 0}, static_cast<std::uint64_t>(angle));
    int near_normal = 0;
    const int count = 20'000;
    for (int i = 0; i < count; ++i) {
      const PrismPass pass = film.trace(natural(travel(angle, 90.0, true)), rng);
      const Vec3& k = pass.light->frame.k;
      near_normal += k.z() > std::cos(8 * kRad);
      if (pass.facets == 2 && pass.base_faces == 1 && k.z() > std::cos(20 * kRad)) {
        ASSERT_NEAR(k.y(), std::sin(exit), 1e-9);
      }
    }
    EXPECT_GT(near_normal, 0.75 * count) << angle;
  }
}

TEST(PrismFilm, FlatTipPassesNormalLight) {
  // What meets the flat (a fifth of the pitch) passes two faces at normal incidence; the slopes return the rest.
  PrismFilmSpec spec;
  spec.profile.tip_flat = 0.2 * spec.profile.pitch;
  const PrismFilm film(spec);
  const double T = transmittance(0.0, 1.0, kIndex, true);
  core::PhotonRng rng({9, 0, 0}, 0);
  const int count = 100'000;
  int straight = 0;
  for (int i = 0; i < count; ++i) {
    const PrismPass pass = film.trace(natural(Vec3::UnitZ()), rng);
    straight += pass.facets == 1 && pass.base_faces == 1 && pass.light->frame.k.z() > 1.0 - 1e-9;
  }
  EXPECT_LT(std::abs(tests::binomial_z(straight, count, 0.2 * T * T)), tests::two_sided_z(1e-4));
}

TEST(PrismFilm, RefusesWhatIsNoFilm) {
  PrismFilmSpec spec;
  spec.refractive_index = 1.0;
  EXPECT_THROW(PrismFilm{spec}, core::Error);
  spec = {};
  spec.base = -0.1;
  EXPECT_THROW(PrismFilm{spec}, core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
