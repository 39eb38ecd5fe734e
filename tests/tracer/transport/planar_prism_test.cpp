#include "tracer/transport/planar_prism.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/z_test.h"

/// Held against `PrismFilm`, which knows no meridian frames.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

constexpr int kLights = 40'000;

/// What light looks like after the film: means of these are compared.
constexpr std::size_t kFeatures = 17;
using Features = std::array<double, kFeatures>;

Features features(const MeridianLight& light) {
  const double q = light.Q / light.I, u = light.U / light.I, v = light.V / light.I;
  const bool up = light.kz > 0.0;
  Features f{1.0,
             up ? 1.0 : 0.0,
             light.kx,
             light.ky,
             light.kz,
             light.kx * light.kx,
             light.ky * light.ky,
             light.kx * light.ky,
             q * q + u * u + v * v};
  const std::array<double, 8> polarized{
      q, u, v, q * light.kx, u * light.kx, u * light.ky, u * light.kx * light.ky, v * light.kx};
  for (std::size_t i = 0; i < polarized.size(); ++i) f[9 + i] = up ? polarized[i] : -0.5 * polarized[i];
  return f;
}

struct Moments {
  Features sum{}, squares{};
  void add(const Features& f) {
    for (std::size_t i = 0; i < kFeatures; ++i) {
      sum[i] += f[i];
      squares[i] += f[i] * f[i];
    }
  }
  core::Estimate mean(std::size_t i) const {
    const double m = sum[i] / kLights;
    return {m, std::sqrt(std::max(0.0, squares[i] / kLights - m * m) / kLights)};
  }
};

void expect_agreement(const PrismFilmSpec& spec, const StokesVector& light, double limit) {
  const PrismFilm film(spec);
  const auto planar = PlanarPrism::of(&film);
  ASSERT_TRUE(planar);
  core::PhotonRng rng({7, 0, 0}, 0);
  Moments general, mine;
  for (int i = 0; i < kLights; ++i) {
    if (const auto pass = film.trace(light, rng); pass.light) general.add(features(MeridianLight(*pass.light)));
    MeridianLight k(light);
    double optical_depth = -std::log(rng.uniform());
    if (!planar->pass(k, optical_depth, rng)) continue;
    EXPECT_NEAR(k.kx * k.kx + k.ky * k.ky + k.kz * k.kz, 1.0, 1e-14);
    EXPECT_LE(std::hypot(k.Q, k.U, k.V), k.I * (1.0 + 1e-12));
    mine.add(features(k));
  }
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const core::Estimate a = general.mean(i), b = mine.mean(i);
    const double z = z_score({a.value - b.value, std::hypot(a.se, b.se)}, 0.0);
    EXPECT_LT(std::abs(z), limit) << "feature " << i << ": " << a.value << " and " << b.value << ", axis " << spec.axis
                                  << ", apex " << spec.profile.apex << ", k " << light.frame.k.transpose();
  }
}

/// 6 films x 8 lights x 17 means: false alarm 1e-3 for all.
TEST(PlanarPrism, SendsLightWhereTheFilmDoes) {
  constexpr double kRad = core::kRadPerDeg;
  std::vector<PrismFilmSpec> films(6);
  films[1].axis = 90 * kRad;
  films[2].axis = 30 * kRad;
  films[2].profile.apex = 70 * kRad;
  films[3].axis = 120 * kRad;
  films[3].profile.apex = 110 * kRad;
  films[3].absorption = 3.0;
  films[4].axis = 50 * kRad;
  films[4].inverted = true;
  films[4].profile.apex = 64 * kRad;
  films[5].refractive_index = 1.4;
  films[5].base = 0.0;
  const double limit = z_limit(1e-3, 6 * 8 * kFeatures);
  core::PhotonRng rng({8, 0, 0}, 0);
  for (const PrismFilmSpec& spec : films) {
    for (int i = 0; i < 8; ++i) {
      const double z = (i % 2 == 0 ? 1.0 : -1.0) * (0.1 + 0.88 * rng.uniform());
      const double azimuth = 2.0 * core::kPi * rng.uniform(), r = std::sqrt(1.0 - z * z);
      const Vec3 k(r * std::cos(azimuth), r * std::sin(azimuth), z);
      StokesVector light = StokesVector::linear(1.0, 2.0 * core::kPi * rng.uniform(), core::PolarizationFrame::any(k));
      light.Q *= 0.6;
      light.U *= 0.6;
      light.V = i < 4 ? 0.8 : -0.3;
      expect_agreement(spec, light, limit);
    }
  }
}

TEST(PlanarPrism, TakesSharpPrismsOnly) {
  PrismFilmSpec spec;
  const PrismFilm sharp(spec);
  EXPECT_TRUE(PlanarPrism::of(&sharp));
  spec.profile.tip_radius = 0.002;
  const PrismFilm round(spec);
  EXPECT_FALSE(PlanarPrism::of(&round));
  spec.profile.tip_radius = 0.0;
  spec.profile.tip_flat = 0.002;
  const PrismFilm flat(spec);
  EXPECT_FALSE(PlanarPrism::of(&flat));
  EXPECT_FALSE(PlanarPrism::of(nullptr));
}

/// Normal light on a 90 degree film of a high index comes back whole (Porro prism), never up.
TEST(PlanarPrism, NormalLightFromBelowComesBackWhole) {
  const PrismFilm film(PrismFilmSpec{});
  const auto planar = PlanarPrism::of(&film);
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 20'000; ++i) {
    MeridianLight light(StokesVector::unpolarized(1.0, core::PolarizationFrame::any(Vec3::UnitZ())));
    double optical_depth = 1e9;
    ASSERT_TRUE(planar->pass(light, optical_depth, rng));
    ASSERT_NEAR(light.kz, -1.0, 1e-9);
  }
}

}  // namespace
}  // namespace evenglow::tests
