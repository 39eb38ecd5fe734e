#include "tracer/films/diffuser.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::travel;

TEST(Diffuser, SharesAreThoseAsked) {
  const Diffuser film({0.7, 0.25, 0.8, 30.0 * kRad, 0.3});
  for (const double sigma : {0.0, 45.0, 80.0}) {
    const core::Vec3 k = travel(sigma, 33.0, true);
    const auto light = core::StokesVector::unpolarized(1.0, tangential_frame(k).frame);
    double down = 0.0, up = 0.0;
    const auto bins = tests::FilmBins(k).integrals(film, light);
    for (std::size_t b = 0; b < bins.size(); ++b) (b < tests::FilmBins::kSide ? down : up) += bins[b][0];
    EXPECT_NEAR(up, 0.7 * 0.8, 1e-5);
    EXPECT_NEAR(down, 0.25, 1e-5);
    EXPECT_NEAR(film.specular(k).transmission(0, 0), 0.7 * 0.2, 1e-12);
  }
}

TEST(Diffuser, IsReciprocal) {
  core::PhotonRng rng({3, 0, 0}, 0);
  for (const Diffuser& film : {Diffuser({0.7, 0.25, 0.8, 10.0 * kRad, 0.3}), Diffuser({0.7, 0.25, 0.8, {}, 0.3})}) {
    for (int i = 0; i < 200; ++i) {
      const core::Vec3 a = travel(89 * rng.uniform(), 360 * rng.uniform());
      const core::Vec3 b = travel(89 * rng.uniform(), 360 * rng.uniform(), i % 2 == 0);
      const auto f = [&](const core::Vec3& from, const core::Vec3& to) {
        return film.evaluate(core::StokesVector::unpolarized(1.0, tangential_frame(from).frame), to).I;
      };
      EXPECT_NEAR(f(a, b), f(-b, -a), 1e-5 * f(a, b));
    }
  }
}

TEST(Diffuser, FullWidthAtHalfMaximumOfTheLuminance) {
  const Diffuser film({1.0, 0.0, 1.0, 20.0 * kRad, 0.0});
  const auto light = core::StokesVector::unpolarized(1.0, tangential_frame(travel(0, 0)).frame);
  EXPECT_NEAR(film.evaluate(light, travel(10, 77)).I / film.evaluate(light, travel(0, 0)).I, 0.5, 1e-4);
}

TEST(Diffuser, KeepsTheFieldOfLightThatIsScatteredALittle) {
  // Field along x at normal incidence stays along x whatever the azimuth of the scatter.
  const Diffuser film({0.5, 0.5, 1.0, 20.0 * kRad, 0.25});
  for (const bool up : {false, true}) {
    const core::Vec3 k = travel(0, 0, up);
    const auto light = core::StokesVector::linear(1.0, 0.0, {k, core::Vec3::UnitX()});
    for (const double azimuth : {0.0, 30.0, 90.0, 200.0}) {
      for (const bool out_up : {false, true}) {
        const auto out = film.evaluate(light, travel(0.5, azimuth, out_up));
        const core::Vec3 e1 = (core::Vec3::UnitX() - out.frame.k * out.frame.k.x()).normalized();
        EXPECT_NEAR(out.in_frame(e1).Q / out.I, 0.75, 1e-3);
      }
    }
  }
}

TEST(Diffuser, ReflectionTurnsTheHandedness) {
  const Diffuser film({0.5, 0.5, 1.0, {}, 0.0});
  const core::Vec3 k = travel(10, 0);
  const core::StokesVector light{1, 0, 0, 1, tangential_frame(k).frame};
  EXPECT_LT(film.evaluate(light, travel(20, 50, true)).V, 0.0);
  EXPECT_GT(film.evaluate(light, travel(20, 50, false)).V, 0.0);
}

TEST(Diffuser, RefusesWrongShares) {
  EXPECT_THROW(Diffuser({0.8, 0.3, 1.0, {}, 0.0}), core::Error);
  EXPECT_THROW(Diffuser({0.8, 0.1, 1.1, {}, 0.0}), core::Error);
  EXPECT_THROW(Diffuser({0.8, 0.1, 1.0, 0.1 * kRad, 0.0}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
