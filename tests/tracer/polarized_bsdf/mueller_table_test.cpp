#include "tracer/polarized_bsdf/mueller_table.h"

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::mueller_stored;
using tests::NodeIndex;

/// Azimuth of a direction from the geometry itself, against the formula.
TEST(MuellerTable, OutgoingPsiIsTheAngleFromTheRayToTheAxis) {
  for (const double sigma : {0.0, 25.0, 60.0}) {
    for (const double phi : {0.0, 50.0, 180.0, 300.0}) {
      for (const double theta : {5.0, 40.0}) {
        const double s = sigma * kRad, p = phi * kRad, t = theta * kRad;
        const Eigen::Vector3d axis(std::sin(s), 0, -std::cos(s)), u(std::cos(s), 0, std::sin(s));
        const Eigen::Vector3d k =
            std::cos(t) * axis + std::sin(t) * (std::cos(p) * u + std::sin(p) * Eigen::Vector3d::UnitY());
        EXPECT_NEAR(outgoing_psi(0.7, s, p, t), 0.7 - std::atan2(k.y(), k.x()), 1e-12);
      }
    }
  }
  EXPECT_EQ(outgoing_psi(0.7, 0.0, 1.0, 0.0), 0.7) << "the normal itself counts from +x";
}

TEST(MuellerTable, NodesComeBack) {
  const BsdfTable dbef = BsdfTable::read(tests::data_file("dbef.csv"));
  const StoredTable stored = tests::mueller_of(dbef, false);
  const MuellerTable table(stored);
  const auto& a = table.axes();
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const auto slice = table.slice(kind, a.psi[1], a.sigma[3], 550);
    for (std::size_t f = 0; f < a.phi.size(); ++f) {
      for (std::size_t t = 0; t < a.theta.size(); ++t) {
        const auto M = slice.at(a.phi[f], a.theta[t]);
        const auto& node = dbef.node(kind, 1, 3, f, t, 0);
        EXPECT_NEAR(M(0, 0), 0.5 * (node.tau_min + node.tau_max), 1e-9 * M(0, 0));
        EXPECT_GT(core::least_coherency_eigenvalue(M), -1e-12);
      }
    }
  }
}

/// Between the nodes everything stays physical, whatever the neighbors are.
TEST(MuellerTable, InterpolationKeepsMatricesPhysical) {
  core::PhotonRng rng({20260110, 0, 0}, 0);
  const StoredTable stored = mueller_stored(
      "m.csv", {0}, {{{0, 90}, {0, 50}, {0, 120, 240}, {0, 10, 40}, {450, 650}}},
      [&](const NodeIndex&) -> core::MuellerMatrix {
        return (0.01 + rng.uniform()) * core::rotator(3 * rng.uniform()) * core::diattenuator(rng.uniform(), 0.0) *
               core::retarder(6 * rng.uniform()) * core::rotator(3 * rng.uniform());
      });
  const MuellerTable table(stored);
  for (int i = 0; i < 200; ++i) {
    const auto slice =
        table.slice(ScatterKind::reflection, 3.1 * rng.uniform(), rng.uniform(), 400 + 300 * rng.uniform());
    EXPECT_GT(core::least_coherency_eigenvalue(slice.at(6.2 * rng.uniform(), rng.uniform())), -1e-12);
  }
}

TEST(MuellerTable, LinearPolarizationFollowsTheRuleOfABsdfTable) {
  const BsdfTable dbef = BsdfTable::read(tests::data_file("dbef.csv"));
  const MuellerTable table(tests::mueller_of(dbef, false));
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const auto a = table.slice(kind, 0.3, 0.4, 550);
    const auto b = dbef.slice(kind, 0.3, 0.4, 550);
    for (const double theta : {0.03, 0.22, 0.6}) {
      const auto M = a.at(1.1, theta);
      const auto v = b.at(1.1, theta);
      EXPECT_NEAR(2.0 * M(0, 0), v.S, 1e-9 * v.S);
      EXPECT_NEAR(-2.0 * M(0, 1), v.S * v.x, 1e-9 * v.S);
      EXPECT_NEAR(-2.0 * M(0, 2), v.S * v.y, 1e-9 * v.S);
    }
  }
}

TEST(MuellerTable, WavelengthsInterpolateByTheSameRule) {
  const StoredTable stored =
      mueller_stored("m.csv", {1}, {{{0}, {0}, {0}, {0}, {400, 600}}}, [](const NodeIndex& i) -> core::MuellerMatrix {
        return i[5] == 0 ? core::MuellerMatrix(0.1 * core::rotator(0.0))
                         : core::MuellerMatrix(0.4 * core::rotator(0.5));
      });
  const MuellerTable table(stored);
  const auto M = table.slice(ScatterKind::transmission, 0, 0, 450).at(0, 0);
  const core::MuellerMatrix expected =
      std::exp(0.75 * std::log(0.1) + 0.25 * std::log(0.4)) * (0.75 * core::rotator(0.0) + 0.25 * core::rotator(0.5));
  EXPECT_LT((M - expected).norm(), 1e-12);
}

TEST(MuellerTable, RoundingIsMixedAwayAndZeroStaysZero) {
  const StoredTable stored =
      mueller_stored("m.csv", {0}, {{{0}, {0}, {0}, {0, 10}, {550}}}, [](const NodeIndex& i) -> core::MuellerMatrix {
        core::MuellerMatrix M = core::MuellerMatrix::Identity();
        M(1, 1) += 1e-6;  // least eigenvalue -2.5e-7
        return i[4] == 0 ? M : core::MuellerMatrix(core::MuellerMatrix::Zero());
      });
  const MuellerTable table(stored);
  const auto slice = table.slice(ScatterKind::reflection, 0, 0, 550);
  EXPECT_GT(core::least_coherency_eigenvalue(slice.at(0, 0)), -1e-15);
  EXPECT_LT((slice.at(0, 0) - core::MuellerMatrix::Identity()).norm(), 1e-5);
  EXPECT_LT(slice.at(0, 10 * kRad).norm(), 1e-11);
}

TEST(MuellerTable, RefusesTheOtherForm) {
  EXPECT_THROW(MuellerTable::read(tests::data_file("dbef.csv")), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tracer
