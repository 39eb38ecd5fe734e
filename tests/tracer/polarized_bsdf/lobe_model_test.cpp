#include "tracer/polarized_bsdf/lobe_model.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/montecarlo/photon_rng.h"
#include "tests/support/films.h"
#include "tracer/polarized_bsdf/lobe_table.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;

const LobeModel& fitted() {
  static const LobeModel model{LobeParameters{}};
  return model;
}

constexpr ScatterKind kKinds[] = {ScatterKind::reflection, ScatterKind::transmission};
constexpr FilmLight kLights[] = {FilmLight::pass, FilmLight::block};

/// Largest relative deviation from the nodes of configs/data/dbef.csv, less half a unit of its last digit; rays more
/// than `least_cosine` above the horizon.
double largest_deviation(double sigma_from, double sigma_to, double theta_to, double least_cosine) {
  const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  const BsdfTable::Axes& a = table.axes();
  double worst = 0.0;
  for (const ScatterKind kind : kKinds) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 0; t < a.theta.size(); ++t) {
            const double cosine = std::cos(a.theta[t]) * std::cos(a.sigma[s]) -
                                  std::sin(a.theta[t]) * std::cos(a.phi[f]) * std::sin(a.sigma[s]);
            if (cosine < least_cosine || a.theta[t] > theta_to * kRad + 1e-9) continue;
            if (a.sigma[s] < sigma_from * kRad - 1e-9 || a.sigma[s] > sigma_to * kRad + 1e-9) continue;
            const auto& node = table.node(kind, p, s, f, t, 0);
            const auto value = fitted().at(kind, a.psi[p], a.sigma[s], a.phi[f], a.theta[t]);
            const auto off = [&](double v, double n) { return std::abs(v / n - 1.0) - 5e-5; };
            worst = std::max({worst, off(std::min(value.pass, value.block), node.tau_min),
                              off(std::max(value.pass, value.block), node.tau_max)});
          }
        }
      }
    }
  }
  return worst;
}

// The parameters are printed with four to six digits, the table was made from more: t1 = 0.09702 alone leaves T_p open
// by 7e-5, and so R_p, which is 1 - absorption - T_p = 0.098, by 7e-4; the medians of the deviation are 5e-5 and 5e-4.
TEST(LobeModel, MeetsTheNodesOfTheDataSet) {
  EXPECT_LT(largest_deviation(0, 30, 10, 0.35), 1e-3);
  EXPECT_LT(largest_deviation(0, 30, 50, 0.35), 3e-3);
  EXPECT_LT(largest_deviation(45, 45, 30, 0.35), 8e-3);
}

// Here the data set's grid for c met the horizon in another way; the totals are the same.
TEST(LobeModel, StaysNearTheDataSetAtSixtyDegrees) {
  EXPECT_LT(largest_deviation(60, 60, 10, 0.35), 0.05);
}

// At 60 degrees the stated T_p, 0.818, is not 1 - absorption - R_p = 0.815 of the same line: limit 4e-3.
TEST(LobeModel, TotalsAreThoseOfTheDataSet) {
  struct Row {
    double sigma, t_pass, r_pass, t_block, r_block;
  };
  for (const Row& row : {Row{0, 0.887, 0.098, 0.053, 0.932}, Row{30, 0.884, 0.101, 0.053, 0.932},
                         Row{45, 0.872, 0.114, 0.052, 0.933}, Row{60, 0.818, 0.170, 0.049, 0.937}}) {
    const auto rho = [&](ScatterKind kind, FilmLight light) {
      return fitted().hemispherical(kind, light, row.sigma * kRad);
    };
    EXPECT_NEAR(rho(ScatterKind::transmission, FilmLight::pass), row.t_pass, 4e-3) << row.sigma;
    EXPECT_NEAR(rho(ScatterKind::reflection, FilmLight::pass), row.r_pass, 1e-3) << row.sigma;
    EXPECT_NEAR(rho(ScatterKind::transmission, FilmLight::block), row.t_block, 1e-3) << row.sigma;
    EXPECT_NEAR(rho(ScatterKind::reflection, FilmLight::block), row.r_block, 1e-3) << row.sigma;
  }
  EXPECT_NEAR(fitted().unscaled(ScatterKind::reflection, FilmLight::pass), 0.098, 6e-4);
  EXPECT_NEAR(fitted().unscaled(ScatterKind::reflection, FilmLight::block), 0.932, 6e-4);
}

/// Integral of f over the hemisphere, by midpoints in polar coordinates of the unit disk of beta.
double integral(ScatterKind kind, FilmLight light, const LobeModel::Beta& in) {
  constexpr int kR = 600, kPhi = 600;
  double sum = 0.0;
  for (int i = 0; i < kR; ++i) {
    const double r = (i + 0.5) / kR;
    for (int j = 0; j < kPhi; ++j) {
      const double phi = 2.0 * core::kPi * (j + 0.5) / kPhi;
      sum += r * fitted().bsdf(kind, light, in, {r * std::cos(phi), r * std::sin(phi)});
    }
  }
  return sum / kR * 2.0 * core::kPi / kPhi;
}

// At 60 degrees the lobe reaches the horizon, where c of reflected pass light rises steeply between its nodes; the film
// in use is normalized to the totals.
TEST(LobeModel, IntegratesToItsTotals) {
  for (const ScatterKind kind : kKinds) {
    for (const FilmLight light : kLights) {
      for (const double sigma : {0.0, 30.0, 60.0}) {
        for (const double psi : {0.0, 50.0}) {
          const double s = std::sin(sigma * kRad);
          const LobeModel::Beta in{s * std::cos(psi * kRad), -s * std::sin(psi * kRad)};
          const double rho = fitted().hemispherical(kind, light, sigma * kRad);
          EXPECT_NEAR(integral(kind, light, in) / rho, 1.0, sigma < 50.0 ? 1e-3 : 2e-2)
              << static_cast<int>(kind) << static_cast<int>(light) << ' ' << sigma << ' ' << psi;
        }
      }
    }
  }
}

/// Angles of a table for a pair of tangential directions, psi counted from the plane of incidence to the film's axis.
LobeModel::Value at_pair(ScatterKind kind, const LobeModel::Beta& in, const LobeModel::Beta& out) {
  const double sigma = std::asin(std::hypot(in.x, in.y)), psi = -std::atan2(in.y, in.x);
  const double c = std::cos(psi), s = std::sin(psi);
  const double bx = out.x * c - out.y * s, by = out.x * s + out.y * c;  // in the plane of incidence
  const double bz = std::sqrt(1.0 - bx * bx - by * by);
  const double along = bx * std::sin(sigma) + bz * std::cos(sigma);
  const double in_plane = bx * std::cos(sigma) - bz * std::sin(sigma);
  return fitted().at(kind, psi, sigma, std::atan2(by, in_plane), std::atan2(std::hypot(in_plane, by), along));
}

// Reversal sends in = beta_1, out = beta_2 to in = -beta_2, out = -beta_1.
TEST(LobeModel, IsReciprocal) {
  core::PhotonRng rng({3, 0, 0}, 0);
  const auto draw = [&] {
    const double r = 0.97 * std::sqrt(rng.uniform()), phi = 2.0 * core::kPi * rng.uniform();
    return LobeModel::Beta{r * std::cos(phi), r * std::sin(phi)};
  };
  for (int i = 0; i < 2000; ++i) {
    const LobeModel::Beta a = draw(), b = draw();
    for (const ScatterKind kind : kKinds) {
      const auto there = at_pair(kind, a, b), back = at_pair(kind, {-b.x, -b.y}, {-a.x, -a.y});
      EXPECT_NEAR(back.pass / there.pass, 1.0, 1e-4);
      EXPECT_NEAR(back.block / there.block, 1.0, 1e-4);
    }
  }
}

TEST(LobeModel, RefusesAFilmThatMakesEnergy) {
  LobeParameters bright;
  bright.a1 *= 1.5;
  EXPECT_THROW(LobeModel{bright}, core::Error);
  LobeParameters wide;
  wide.p3 *= 3.0;
  EXPECT_THROW(LobeModel{wide}, core::Error);
}

TEST(LobeTable, HoldsTheModelAtItsNodes) {
  const BsdfTable table = lobe_table(fitted());
  const auto& a = table.axes();
  for (const ScatterKind kind : kKinds) {
    for (const std::size_t s : {0u, 6u, 12u}) {
      for (const std::size_t p : {0u, 3u, 8u}) {
        const auto& node = table.node(kind, p, s, 5, 12, 0);
        const auto value = fitted().at(kind, a.psi[p], a.sigma[s], a.phi[5], a.theta[12]);
        EXPECT_NEAR(node.tau_min, std::min(value.pass, value.block), 1e-12);
        EXPECT_NEAR(node.tau_max, std::max(value.pass, value.block), 1e-12);
      }
    }
  }
}

TEST(LobeTable, FilmFollowsTheModel) {
  const auto totals = lobe_hemispherical(fitted());
  const TabulatedDbef film(lobe_table(fitted()), 550.0, &totals, 0.0);
  double sum = 0.0, weights = 0.0;
  for (const double sigma : {1e-4, 20.0, 47.0}) {
    for (const double theta : {2.0, 5.0, 10.0, 17.0, 25.0}) {
      for (const double phi : {0.0, 70.0, 200.0}) {
        const core::Vec3 k(std::sin(sigma * kRad), 0, -std::cos(sigma * kRad));
        const core::Vec3 axis(k.x(), 0, -k.z()), u(-k.z(), 0, -k.x());
        const core::Vec3 out =
            axis * std::cos(theta * kRad) +
            (u * std::cos(phi * kRad) + core::Vec3::UnitY() * std::sin(phi * kRad)) * std::sin(theta * kRad);
        const auto light = core::StokesVector::unpolarized(1.0, tangential_frame(k).frame);
        const auto v = fitted().at(ScatterKind::reflection, 0.0, sigma * kRad, phi * kRad, theta * kRad);
        const double expected = 0.5 * (v.pass + v.block);
        sum += std::abs(film.evaluate(light, out.normalized()).I - expected) * theta;
        weights += expected * theta;
      }
    }
  }
  EXPECT_LT(sum / weights, 0.015);
}

}  // namespace
}  // namespace evenglow::tracer
