#include "tracer/polarized_bsdf/mueller_fit.h"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/synthetic_film.h"
#include "tests/support/z_test.h"

namespace evenglow::tracer {
namespace {

using core::MuellerMatrix;
using tests::add_noise;
using tests::mueller_readings;
using tests::Pulls;
using tests::random_physical;

MuellerMatrix diattenuating_film(double tau_min, double tau_max, double d_in, double d_out, double kappa) {
  return core::rotator(-d_out) * core::diattenuator(tau_min, tau_max, kappa) * core::rotator(d_in);
}

/// How far chi-square can be above that of the best physical matrix: the duality gap of a convex problem. With Z the
/// gradient of chi-square as a Hermitian matrix, it is trace(Z H) less the least eigenvalue of Z (if negative) times
/// the trace of H.
double chi_square_gap(const std::vector<MuellerReading>& readings, const MuellerMatrix& M) {
  CoherencyMatrix Z = CoherencyMatrix::Zero();
  for (const MuellerReading& r : readings) {
    const double residual = 2.0 * (r.out.dot(M * r.in) - r.value) / (r.se * r.se);
    for (int k = 0; k < 16; ++k) {
      Z += residual * r.out[k / 4] * r.in[k % 4] * coherency_basis()[static_cast<std::size_t>(k)];
    }
  }
  const CoherencyMatrix H = coherency_matrix(M);
  const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> eigen(Z);
  return std::abs((Z * H).trace().real()) + std::max(0.0, -eigen.eigenvalues()[0]) * H.trace().real();
}

TEST(Coherency, IsTheInverseOfItselfAndAgreesWithTheCore) {
  std::mt19937_64 rng(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    MuellerMatrix M;
    for (int k = 0; k < 16; ++k) M(k / 4, k % 4) = normal(rng);
    M(0, 0) = std::abs(M(0, 0)) + 0.1;
    EXPECT_LT((mueller_matrix(coherency_matrix(M)) - M).norm(), 1e-14);
    const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> eigen(coherency_matrix(M));
    EXPECT_NEAR(eigen.eigenvalues()[0] / M(0, 0), core::least_coherency_eigenvalue(M), 1e-10);
  }
}

TEST(MuellerFit, IsExactWithoutNoise) {
  std::mt19937_64 rng(3);
  for (int i = 0; i < 300; ++i) {
    const MuellerMatrix M =
        i % 2 == 0 ? random_physical(1 + i % 4, 0.0, rng) : diattenuating_film(0.1, 0.01 * i, 0.01 * i, 0.7, 1.0);
    for (const bool many : {false, true}) {
      const MuellerFit fit = fit_mueller(mueller_readings(M, many));
      ASSERT_LT((fit.M - M).norm(), 1e-12 * M.norm()) << i;
      ASSERT_LT(fit.chi_square_increase, 1e-20);
    }
  }
}

/// Pulls of all 16 entries where the constraint does not act.
void expect_unit_pulls(double noise, bool many) {
  constexpr int kFilms = 12000;
  std::mt19937_64 rng(5);
  std::array<Pulls, 16> pulls;
  double chi_square = 0.0;
  int degrees = 0, constrained = 0;
  for (int i = 0; i < kFilms; ++i) {
    const MuellerMatrix M = random_physical(4, 0.7, rng);
    auto readings = mueller_readings(M, many);
    add_noise(readings, noise * 0.5, rng);  // M00 = 1: the mean reading is 1/2
    const MuellerFit fit = fit_mueller(readings);
    constrained += fit.constrained ? 1 : 0;
    for (int k = 0; k < 16; ++k) {
      pulls[static_cast<std::size_t>(k)].add(fit.unconstrained(k / 4, k % 4), M(k / 4, k % 4),
                                             std::sqrt(fit.constrained ? 0.0 : fit.covariance(k, k)));
    }
    chi_square += fit.chi_square;
    degrees += fit.degrees_of_freedom;
  }
  EXPECT_EQ(constrained, 0) << "these films are deep inside the cone";
  // 16 x 6 means in all; one false alarm in a million. Widths: 5 % is 7.7 standard errors.
  const double mean_limit = tests::z_limit(1e-6, 96) / std::sqrt(static_cast<double>(kFilms));
  for (const Pulls& p : pulls) {
    EXPECT_NEAR(p.width(), 1.0, 0.05);
    EXPECT_NEAR(p.mean(), 0.0, mean_limit);
  }
  if (many) {
    EXPECT_NEAR(chi_square / degrees, 1.0, tests::z_limit(1e-6, 3) * std::sqrt(2.0 / degrees));
  }
}

TEST(MuellerFit, PullsAreOfUnitWidthAtOnePercent) {
  expect_unit_pulls(0.01, true);
}
TEST(MuellerFit, PullsAreOfUnitWidthAtFivePercent) {
  expect_unit_pulls(0.05, true);
}
TEST(MuellerFit, PullsAreOfUnitWidthAtTenPercent) {
  expect_unit_pulls(0.10, true);
}
TEST(MuellerFit, PullsAreOfUnitWidthWithSixteenReadings) {
  expect_unit_pulls(0.01, false);
}

TEST(MuellerFit, ConstrainedFitIsPhysicalAndTheBestOfAll) {
  std::mt19937_64 rng(23);
  int constrained = 0;
  for (int i = 0; i < 300; ++i) {
    const MuellerMatrix M = random_physical(1 + i % 3, 0.0, rng);
    auto readings = mueller_readings(M, i % 2 == 0);
    add_noise(readings, (i % 5 == 0 ? 0.1 : 0.01) * 0.5, rng);
    if (i % 3 == 0) {
      for (std::size_t k = 0; k < readings.size(); k += 3) readings[k].se *= 5.0;  // unequal weights
    }
    const MuellerFit fit = fit_mueller(readings);
    ASSERT_TRUE(core::is_physical(fit.M, 1e-12)) << i;
    if (!fit.constrained) continue;
    ++constrained;
    EXPECT_LT(fit.least_eigenvalue, 0.0);
    EXPECT_GT(fit.chi_square_increase, 0.0);
    EXPECT_LT(chi_square_gap(readings, fit.M), 0.1) << i;
  }
  EXPECT_GT(constrained, 200);
}

TEST(MuellerFit, ConstraintBringsNoisyPureFilmsNearerToTheTruth) {
  std::mt19937_64 rng(29);
  std::uniform_real_distribution<double> uniform;
  constexpr int kFilms = 1500;
  double free = 0.0, physical = 0.0, increase = 0.0;
  Pulls high;
  for (int i = 0; i < kFilms; ++i) {
    const MuellerMatrix M = diattenuating_film(0.2, 1.8, core::kPi * uniform(rng), core::kPi * uniform(rng), 1.0);
    auto readings = mueller_readings(M, true);
    add_noise(readings, 0.05 * 0.5, rng);
    const MuellerFit fit = fit_mueller(readings);
    free += (fit.unconstrained - M).squaredNorm();
    physical += (fit.M - M).squaredNorm();
    increase += fit.chi_square_increase;
    const DiattenuatorValues v = diattenuator_values(table_form(fit.M, fit.covariance).row);
    high.add(v.tau_max, 1.8, v.tau_max_se);
  }
  EXPECT_LT(physical, 0.75 * free);
  // A matrix of rank 1 has 7 numbers; the other 9 directions are taken back from noise where they point outwards.
  EXPECT_GT(increase / kFilms, 1.0);
  EXPECT_LT(increase / kFilms, 9.0);
  RecordProperty("pull_mean_per_mille", static_cast<int>(1000.0 * high.mean()));
  RecordProperty("pull_width_per_mille", static_cast<int>(1000.0 * high.width()));
  EXPECT_LT(std::abs(high.mean()), 0.5) << "biased by less than half a standard error";
  // The rank found is often above the true one, and the errors with it: they are a little too large, never too small.
  EXPECT_GT(high.width(), 0.8);
  EXPECT_LT(high.width(), 1.05);
}

TEST(MuellerFit, TellsDataThatNoFilmCanGive) {
  MuellerMatrix M = MuellerMatrix::Identity();
  M(3, 3) = -1.0;  // mirrors V alone: least eigenvalue -1/2
  auto readings = mueller_readings(M, true);
  for (MuellerReading& r : readings) r.se = 0.01;
  const MuellerFit fit = fit_mueller(readings);
  EXPECT_TRUE(fit.constrained);
  EXPECT_NEAR(fit.least_eigenvalue, -0.5, 1e-12);
  EXPECT_LT(fit.least_eigenvalue / fit.least_eigenvalue_se, -20.0);
  EXPECT_GT(std::sqrt(fit.chi_square_increase), 20.0);
}

TEST(MuellerFit, RefusesReadingsThatDoNotDetermineAllEntries) {
  const MuellerMatrix M = core::diattenuator(0.2, 1.0);
  auto readings = mueller_readings(M, true);
  std::erase_if(readings, [](const MuellerReading& r) { return r.in[3] != 0.0; });  // nothing circular goes in
  const ReadingRank rank = reading_rank(readings);
  EXPECT_EQ(rank.all, 12);
  EXPECT_EQ(rank.illumination, 3);
  EXPECT_EQ(rank.observation, 4);
  EXPECT_THROW(fit_mueller(readings), core::Error);
}

TEST(MuellerFit, TableFormFindsKappaAndWhatIsLeftOut) {
  std::mt19937_64 rng(31);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 200; ++i) {
    const double low = uniform(rng), high = low + uniform(rng), kappa = uniform(rng), d_in = 3.0 * uniform(rng) - 1.5;
    const MuellerMatrix M = diattenuating_film(low, high, d_in, 3.0 * uniform(rng), kappa);
    const TableForm form = table_form(M, MuellerCovariance::Identity() * 1e-6);
    const DiattenuatorValues v = diattenuator_values(form.row);
    EXPECT_NEAR(v.tau_min, low, 1e-12);
    EXPECT_NEAR(v.tau_max, high, 1e-12);
    EXPECT_NEAR(half_turn(v.delta - d_in), 0.0, 1e-9);
    EXPECT_NEAR(form.kappa, kappa, 1e-9);
    EXPECT_LT(form.rest, 1e-6);
  }
  const MuellerMatrix wave = core::rotator(-0.3) * core::retarder(1.0) * core::rotator(0.3);
  EXPECT_GT(table_form(wave, MuellerCovariance::Zero()).rest, 0.1) << "a wave plate has no place in the table";
}

}  // namespace
}  // namespace evenglow::tracer
