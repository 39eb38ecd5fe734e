#include "tracer/polarized_bsdf/sampled_bsdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/films.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;

TEST(OutgoingPolar, HorizonLiesOnTheUnitCircle) {
  for (const double sigma : {0.0, 30.0, 80.0, 89.99}) {
    for (double phi = 0.0; phi < 6.28; phi += 0.1) {
      const double s = std::sin(sigma * kRad), c = std::cos(sigma * kRad);
      const double r = horizon_distance(s, c * c, std::cos(phi), std::sin(phi));
      EXPECT_GT(r, 0.0);
      EXPECT_NEAR(std::hypot(s + r * std::cos(phi), r * std::sin(phi)), 1.0, 1e-14);
    }
  }
}

TEST(IncidenceGrid, WeightsAreThoseOfTheDraw) {
  const IncidenceGrid grid;
  for (const auto& [psi, sigma] : {std::pair{0.0, 0.0}, {0.1, 12.0}, {3.1, 45.0}, {1.0, 88.0}, {2.0, 89.9}}) {
    const double cos2 = std::pow(std::cos(sigma * kRad), 2);
    const auto cell = grid.cell(psi, cos2);
    std::vector<double> shares(grid.size(), 0.0);
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) shares[grid.draw(psi, cos2, (i + 0.5) / kSteps)] += 1.0 / kSteps;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(shares[cell.node[i]], cell.weight[i], 5e-5) << psi << ' ' << sigma;
      shares[cell.node[i]] = 0.0;
    }
    for (const double rest : shares) EXPECT_EQ(rest, 0.0);
  }
}

TEST(IncidenceGrid, ANodeIsItself) {
  const IncidenceGrid grid;
  for (std::size_t n = 0; n < grid.size(); ++n) {
    const auto cell = grid.cell(grid.psi(n), grid.cos2_sigma(n));
    double own = 0.0;
    for (std::size_t i = 0; i < 4; ++i) own += cell.node[i] == n ? cell.weight[i] : 0.0;
    EXPECT_NEAR(own, 1.0, 1e-12);
  }
}

TEST(SampledBsdf, IntegralsAreThoseOfTheInterpolant) {
  // Three-point Gauss-Legendre on panels that end at the grid lines (32 x 40): exact in u, 1e-7 in phi'.
  constexpr std::array<double, 3> kAt{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> kWeight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  constexpr int kU = 32, kPhi = 320;
  const auto totals = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  const SampledBsdf bsdf(BsdfTable::read(tests::data_file("dbef.csv")), 550.0, &totals, 1.58);
  for (const std::size_t node : {0u, 30u, 42u, 90u}) {
    for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
      double S = 0.0, x = 0.0, y = 0.0;
      for (std::size_t p = 0; p < 3 * kPhi; ++p) {
        const double phi = 2.0 * core::kPi * (static_cast<double>(p / 3) + kAt[p % 3]) / kPhi;
        for (std::size_t i = 0; i < 3 * kU; ++i) {
          const double u = (static_cast<double>(i / 3) + kAt[i % 3]) / kU;
          const auto r = bsdf.response(node, kind, u, phi, std::cos(phi), std::sin(phi));
          const double weight = 2.0 * u * u * u * kWeight[i % 3] / kU * 2.0 * core::kPi * kWeight[p % 3] / kPhi;
          S += weight * r.S;
          x += weight * r.x;
          y += weight * r.y;
        }
      }
      const auto& integral = bsdf.integral(node, kind);
      EXPECT_NEAR(integral.S, S, 1e-7) << node;
      EXPECT_NEAR(integral.x, x, 1e-7) << node;
      EXPECT_NEAR(integral.y, y, 1e-7) << node;
    }
  }
}

TEST(SampledBsdf, DrawsFollowTheInterpolantInsideACell) {
  // Positions within the cells of all draws, folded on one cell of 8 x 8 bins. False alarm 1e-4 for each of four.
  constexpr std::size_t kBins = 8, kU = 32, kPhi = 40;
  const SampledBsdf bsdf(BsdfTable::read(tests::data_file("dbef.csv")), 550.0, nullptr, 1.58);
  const auto fold = [](double x, std::size_t cells) {
    return x * static_cast<double>(cells) - std::floor(x * static_cast<double>(cells));
  };
  for (const std::size_t node : {30u, 42u, 90u, 20u}) {
    const double q1 = 0.6, q2 = -0.3;
    std::vector<double> counts(kBins * kBins, 0.0), expected(kBins * kBins, 0.0);
    core::PhotonRng rng({9, 0, 0}, node);
    constexpr int kDraws = 400000;
    for (int i = 0; i < kDraws; ++i) {
      const auto d = bsdf.draw(node, q1, q2, rng);
      const double t = fold(full_angle(d.sin_phi, d.cos_phi) / (2.0 * core::kPi), kPhi);
      counts[static_cast<std::size_t>(fold(d.u, kU) * kBins) * kBins + static_cast<std::size_t>(t * kBins)] += 1.0;
    }
    constexpr std::size_t kFine = 4;  // midpoints in each bin
    for (std::size_t p = 0; p < kPhi * kBins * kFine; ++p) {
      const double phi = 2.0 * core::kPi * (static_cast<double>(p) + 0.5) / (kPhi * kBins * kFine);
      for (std::size_t i = 0; i < kU * kBins * kFine; ++i) {
        const double u = (static_cast<double>(i) + 0.5) / (kU * kBins * kFine);
        double power = 0.0;
        for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
          power += bsdf.response(node, kind, u, phi, std::cos(phi), std::sin(phi)).power(q1, q2);
        }
        expected[i / kFine % kBins * kBins + p / kFine % kBins] += power * u * u * u;
      }
    }
    const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
    for (double& e : expected) e *= kDraws / sum;
    EXPECT_GT(tests::chi_square_test(counts, expected).p_value, 1e-4) << node;
  }
}

TEST(SampledBsdf, NeverGivesMoreThanItGets) {
  const SampledBsdf bsdf(BsdfTable::read(tests::data_file("dbef.csv")), 550.0, nullptr, 1.58);
  for (std::size_t n = 0; n < bsdf.incidences().size(); ++n) {
    const auto& total = bsdf.integral(n);
    EXPECT_LE(0.5 * (total.S + std::hypot(total.x, total.y)), 1.0 + 1e-6);
  }
}

TEST(SampledBsdf, KeepsItsTotalsBeyondTheLastIncidence) {
  // Data that end at 30 degrees, a lobe that the horizon cuts more and more. The film must not turn black for it.
  std::string text = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";
  for (const char* kind : {"BRDF", "BTDF"}) {
    for (const char* sigma : {"0", "30"}) {
      for (const char* lobe : {"0,550,0.1,0.6", "20,550,0.05,0.3", "40,550,0.01,0.06", "70,550,0.001,0.006"}) {
        text += std::string(kind) + ",0," + sigma + ",0," + lobe + ",0\n";
      }
    }
  }
  const SampledBsdf bsdf(BsdfTable::parse(text, "short.csv"), 550.0, nullptr, 1.58);
  const IncidenceGrid& grid = bsdf.incidences();
  double at_30 = 0.0;
  for (std::size_t n = 0; n < IncidenceGrid::kSigma; ++n) {
    if (std::abs(grid.sigma(n) - 30.0 * kRad) < 1e-9) at_30 = bsdf.integral(n).S;
    if (grid.sigma(n) > 31.0 * kRad) {
      EXPECT_NEAR(bsdf.integral(n).S / at_30, 1.0, 1e-4) << grid.sigma(n) / kRad;
    }
  }
  EXPECT_GT(at_30, 0.1);
  ASSERT_EQ(bsdf.remarks().size(), 1u);
  EXPECT_EQ(bsdf.remarks()[0],
            "short.csv: no data beyond sigma = 30 degrees; the lobes of that incidence are held, and its totals");
}

/// Pairs of nodes that are mirror images to the last bit: those that share their tables.
std::size_t shared_nodes(const SampledBsdf& bsdf) {
  const IncidenceGrid& grid = bsdf.incidences();
  std::size_t shared = 0;
  for (std::size_t node = 0; node < grid.size(); ++node) {
    const std::size_t twin = grid.mirrored(node);
    if (twin >= node) continue;
    EXPECT_NEAR(grid.psi(node) + grid.psi(twin), core::kPi, 1e-12);
    EXPECT_EQ(grid.sigma(node), grid.sigma(twin));
    const double phi = 1.1;
    const auto a = bsdf.response(node, ScatterKind::reflection, 0.3, phi, std::cos(phi), std::sin(phi));
    const auto b =
        bsdf.response(twin, ScatterKind::reflection, 0.3, 2.0 * core::kPi - phi, std::cos(phi), -std::sin(phi));
    if (std::abs(a.S - b.S) < 1e-6 * a.S && std::abs(a.y + b.y) < 1e-6 * a.S) ++shared;
  }
  return shared;
}

TEST(SampledBsdf, MirrorImagesShareTheirTables) {
  const SampledBsdf bsdf(BsdfTable::read(tests::data_file("dbef.csv")), 550.0, nullptr, 1.58);
  EXPECT_EQ(shared_nodes(bsdf), 5 * IncidenceGrid::kSigma);
  EXPECT_LT(bsdf.bytes(), 3'300'000u);
}

TEST(SampledBsdf, AFilmWithoutMirrorSymmetryKeepsAllTables) {
  std::string text = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";
  for (const char* incidence : {"0,0", "45,0", "90,0", "135,0", "0,60", "45,60", "90,60", "135,60"}) {
    const bool odd = std::string(incidence).substr(0, 3) == "135";
    for (const char* phi : {"0", "90", "180", "270"}) {
      for (const char* theta : {"0", "40", "80"}) {
        text += std::string("BRDF,") + incidence + "," + phi + "," + theta + ",550,0.05," + (odd ? "0.12" : "0.15") +
                ",0\n";
      }
    }
  }
  const SampledBsdf bsdf(BsdfTable::parse(text, "skew.csv"), 550.0, nullptr, 1.58);
  EXPECT_LT(shared_nodes(bsdf), IncidenceGrid::kSigma);
  EXPECT_GT(bsdf.bytes(), 5'000'000u);
}

TEST(SampledBsdf, StaysWithin16MB) {
  const SampledBsdf bsdf(BsdfTable::read(tests::data_file("dbef.csv")), 550.0, nullptr, 1.58);
  EXPECT_LT(bsdf.bytes(), 16u << 20);
}

}  // namespace
}  // namespace evenglow::tracer
