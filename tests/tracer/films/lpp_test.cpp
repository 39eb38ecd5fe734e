#include "tracer/films/lpp.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::travel;

double transmitted(const Bsdf& film, const core::StokesVector& light) {
  const auto frame = tangential_frame(light.frame.k);
  return (film.specular(light.frame.k).transmission * to_film(light, frame))[0];
}

TEST(Lpp, DefaultPasses43PercentAndPolarizes) {
  const auto film = lpp_surface({});
  const auto light = core::StokesVector::unpolarized(1, tangential_frame(travel(0, 0)).frame);
  const auto frame = tangential_frame(light.frame.k);
  const Eigen::Vector4d out = film.specular(light.frame.k).transmission * to_film(light, frame);
  EXPECT_NEAR(out[0], 0.43, 1e-12);
  EXPECT_GE(out[1] / out[0], 0.999);
}

TEST(Lpp, Malus) {
  const auto film = lpp_surface({1.0, 0.0, 0.0, 0.5});
  for (const bool up : {false, true}) {
    const core::Vec3 k = travel(0, 0, up);
    for (double angle = 0.0; angle < 3.2; angle += 0.2) {
      const core::PolarizationFrame frame{k, core::Vec3(std::cos(angle), std::sin(angle), 0)};
      EXPECT_NEAR(transmitted(film, core::StokesVector::linear(1, 0, frame)), std::pow(std::cos(angle - 0.5), 2),
                  1e-12);
    }
  }
}

TEST(Lpp, CrossedAndThreePolarizers) {
  const core::Vec3 k = travel(0, 0);
  const auto M = [&](double axis) { return lpp_surface({1.0, 0.0, 0.0, axis}).specular(k).transmission; };
  EXPECT_NEAR((M(core::kPi / 2) * M(0))(0, 0), 0.0, 1e-15);
  EXPECT_NEAR((M(core::kPi / 2) * M(core::kPi / 4) * M(0))(0, 0), 0.125, 1e-15);
}

TEST(Lpp, CrossedPolarizersLeakObliquelyAsOTypeFilmsDo) {
  // At 45 degrees from both axes the two pass axes are no longer crossed on the wave front: with c = cos sigma' both
  // make atan c with the plane of incidence, so they enclose 2 atan c.
  const double sigma = 60 * kRad;
  const core::Vec3 k = travel(60, 45);
  const auto M = [&](double axis) { return lpp_surface({1.0, 0.0, 0.0, axis}).specular(k).transmission; };
  const double c = std::sqrt(1.0 - std::pow(std::sin(sigma) / kLppIndex, 2));
  EXPECT_NEAR((M(core::kPi / 2) * M(0))(0, 0), 0.5 * std::pow(std::cos(2.0 * std::atan(c)), 2), 1e-12);
}

TEST(Lpp, SamplesItsShares) {
  const auto film = lpp_surface({0.7, 0.1, 0.2, 0.3});
  core::PhotonRng rng({2, 0, 0}, 0);
  const core::Vec3 k = travel(30, 100, true);
  const auto light = core::StokesVector::linear(3.0, 0.4, tangential_frame(k).frame);
  int passed = 0, reflected = 0;
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    const auto out = film.sample(light, rng);
    if (!out) continue;
    EXPECT_DOUBLE_EQ(out->light.I, 3.0);
    if (out->light.frame.k.z() > 0) {
      ++passed;
    } else {
      ++reflected;
      EXPECT_NEAR(out->light.degree_of_polarization(), 1.0, 1e-12);
    }
  }
  const double p = transmitted(film, light) / 3.0;
  const double se = std::sqrt(p * (1 - p) / kSamples);
  EXPECT_NEAR(passed, p * kSamples, 4.0 * se * kSamples);  // false alarm 6e-5
  EXPECT_NEAR(reflected, 0.2 * kSamples, 4.0 * std::sqrt(0.16 * kSamples));
}

TEST(Lpp, MatricesArePhysicalAndGainIsRefused) {
  const auto specular = lpp_surface({.axis = 1.1}).specular(travel(70, 20));
  EXPECT_TRUE(core::is_physical(specular.transmission));
  EXPECT_TRUE(core::is_physical(specular.reflection));
  EXPECT_THROW(lpp_surface({0.9, 0.0, 0.2, 0.0}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
