#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"
#include "tracer/films/bef.h"

/// What every film of clear prisms must obey. Seeds are fixed; the chance of a false alarm is 1e-4 for each film and
/// law.
namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
using tracer::PrismFilm;
using tracer::PrismFilmSpec;

constexpr double kRad = core::kRadPerDeg;

std::vector<PrismFilmSpec> films() {
  std::vector<PrismFilmSpec> list(6);
  list[1].profile.tip_radius = 0.008;
  list[2].profile.tip_flat = 0.01;
  list[2].axis = 20 * kRad;
  list[3].profile.apex = 64 * kRad;
  list[3].inverted = true;
  list[4].profile.apex = 120 * kRad;
  list[4].refractive_index = 1.7;
  list[5].base = 0.0;
  list[5].profile.apex = 40 * kRad;
  list[5].profile.tip_radius = 0.012;
  return list;
}

/// Lambertian light through the plane of the film, from below and from above alike.
Vec3 isotropic(core::PhotonRng& rng) {
  Vec3 k = core::sample_lambertian(rng.uniform(), rng.uniform());
  if (rng.uniform() < 0.5) k.z() = -k.z();
  return k;
}

/// Cells of equal etendue: side (0 below), cos^2 of the polar angle, azimuth.
struct Cells {
  std::size_t polar, azimuth;
  std::size_t count() const { return 2 * polar * azimuth; }
  /// Of the direction in which a point on the film sees `d`.
  std::size_t index(const Vec3& d) const {
    const auto part = [](double share, std::size_t n) {
      return std::min(static_cast<std::size_t>(share * static_cast<double>(n)), n - 1);
    };
    const double turn = std::atan2(d.y(), d.x()) / (2.0 * core::kPi);
    const std::size_t side = d.z() > 0.0 ? 1 : 0;
    return (side * polar + part(d.z() * d.z(), polar)) * azimuth + part(turn - std::floor(turn), azimuth);
  }
};

TEST(PrismFilmLaws, NoLightIsLost) {
  for (const auto& spec : films()) {
    const PrismFilm film(spec);
    core::PhotonRng rng({11, 0, 0}, 0);
    for (int i = 0; i < 100'000; ++i) {
      const Vec3 k = isotropic(rng);
      const auto lights = test_lights(k);
      const auto pass = film.trace(lights[static_cast<std::size_t>(i) % lights.size()], rng);
      ASSERT_TRUE(pass.light);
      ASSERT_NEAR(pass.light->I, 1.0, 1e-9);
      ASSERT_LE(pass.light->degree_of_polarization(), 1.0 + 1e-9);
      ASSERT_NEAR(pass.light->frame.k.norm(), 1.0, 1e-9);
      ASSERT_NEAR(pass.light->frame.k.dot(pass.light->frame.e1), 0.0, 1e-9);
    }
  }
}

TEST(PrismFilmLaws, IsotropicNaturalLightStaysIsotropicAndNatural) {
  // The second law: a film between two equal black bodies changes nothing, neither radiance nor polarization.
  const Cells cells{8, 16};
  for (const auto& spec : films()) {
    const PrismFilm film(spec);
    core::PhotonRng rng({12, 0, 0}, 0);
    std::vector<double> counts(cells.count(), 0.0);
    std::vector<Eigen::Vector3d> sums(16, Eigen::Vector3d::Zero()), squares(16, Eigen::Vector3d::Zero());
    std::vector<double> n(16, 0.0);
    const int photons = 300'000;
    for (int i = 0; i < photons; ++i) {
      const Vec3 k = isotropic(rng);
      const auto out = *film.trace(StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng).light;
      counts[cells.index(out.frame.k)] += 1.0;
      const auto s = tracer::to_film(out, tracer::tangential_frame(out.frame.k));
      // The azimuth counts from the groove modulo half a turn: mirror images must not cancel U and V.
      const double turn = std::atan2(out.frame.k.y(), out.frame.k.x()) / core::kPi - spec.axis / core::kPi;
      const auto bin = std::min<std::size_t>(static_cast<std::size_t>((turn - std::floor(turn)) * 8.0), 7) +
                       (out.frame.k.z() > 0.0 ? 8 : 0);
      n[bin] += 1.0;
      sums[bin] += s.tail<3>();
      squares[bin] += s.tail<3>().cwiseAbs2();
    }
    const std::vector<double> expected(cells.count(), photons / static_cast<double>(cells.count()));
    EXPECT_GT(chi_square_test(counts, expected).p_value, 1e-4);
    for (std::size_t b = 0; b < 16; ++b) {
      for (int j = 0; j < 3; ++j) {
        EXPECT_LT(std::abs(sums[b][j]), z_limit(1e-4, 48) * std::sqrt(squares[b][j])) << "bin " << b << " Stokes " << j;
      }
    }
  }
}

TEST(PrismFilmLaws, PathsCanBeReversed) {
  // Natural light from cell i to cell j and back weigh the same in equal etendues (Helmholtz).
  const Cells cells{4, 8};
  for (const auto& spec : films()) {
    const PrismFilm film(spec);
    core::PhotonRng rng({13, 0, 0}, 0);
    const std::size_t size = cells.count();
    std::vector<double> N(size * size, 0.0);
    for (int i = 0; i < 300'000; ++i) {
      const Vec3 k = isotropic(rng);
      const auto out = *film.trace(StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng).light;
      N[cells.index(-k) * size + cells.index(out.frame.k)] += 1.0;
    }
    double statistic = 0.0;
    int degrees = 0;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double a = N[i * size + j], b = N[j * size + i];
        if (a + b < 20.0) continue;
        statistic += (a - b) * (a - b) / (a + b);
        ++degrees;
      }
    }
    EXPECT_GT(degrees, 200);
    EXPECT_GT(chi_square_tail(statistic, degrees), 1e-4);
  }
}

}  // namespace
}  // namespace evenglow::tests
