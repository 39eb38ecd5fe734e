#include "tracer/polarized_bsdf/sampled_mueller.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/chi_square.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"

namespace evenglow::tracer {
namespace {

const SampledMueller& sampled() {
  static const MuellerTable table(tests::mueller_stored(
      "m.csv", {0, 1}, {{{0, 90}, {0, 60}, {0, 90, 180, 270}, {0, 10, 40, 80}, {550}}},
      [](const tests::NodeIndex& i) -> core::MuellerMatrix {
        const double peak = 3.0 * std::exp(-0.7 * static_cast<double>(i[4])) * (i[0] == 0 ? 1.0 : 0.6);
        return peak * core::diattenuator(1.0, 0.2) * core::retarder(0.4 * static_cast<double>(i[3])) *
               core::rotator(0.5);
      }));
  static const SampledMueller bsdf(table, 550.0, nullptr, 1.58);
  return bsdf;
}

TEST(SampledMueller, IntegralsAreThoseOfTheResponse) {
  const IncidenceGrid& grid = sampled().incidences();
  for (const std::size_t node : {std::size_t{0}, grid.size() / 2 + 7, grid.size() - 3}) {
    for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
      constexpr int kU = 640, kPhi = 800;
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      for (int i = 0; i < kU; ++i) {
        const double u = (i + 0.5) / kU;
        for (int k = 0; k < kPhi; ++k) {
          const double phi = 2.0 * core::kPi * (k + 0.5) / kPhi;
          sum +=
              2.0 * u * u * u / kU * 2.0 * core::kPi / kPhi * sampled().response(node, kind, u, phi).row(0).transpose();
        }
      }
      EXPECT_LT((sum - sampled().integral(node, kind)).norm(), 1e-4 * sum.norm());
    }
  }
}

/// Draws against the density itself, on 2 x 16 x 10 bins; 6 tests, 1e-3 in all.
TEST(SampledMueller, DrawsFollowTheResponse) {
  const IncidenceGrid& grid = sampled().incidences();
  const Eigen::Vector4d lights[] = {{1, 0, 0, 0}, {1, -0.6, 0.48, 0.64}};
  std::uint32_t stream = 0;
  for (const std::size_t node : {std::size_t{3}, grid.size() / 2, grid.size() - 4}) {
    for (const Eigen::Vector4d& s : lights) {
      constexpr std::size_t kU = 16, kPhi = 10, kSamples = 40000;
      std::vector<double> counts(2 * kU * kPhi), expected(2 * kU * kPhi);
      for (std::size_t b = 0; b < expected.size(); ++b) {
        const auto kind = static_cast<ScatterKind>(b / (kU * kPhi));
        constexpr int kFine = 8;
        for (int i = 0; i < kFine * kFine; ++i) {
          const double u = (static_cast<double>(b % kU) + (i % kFine + 0.5) / kFine) / kU;
          const double phi = 2.0 * core::kPi * (static_cast<double>(b / kU % kPhi) + (i / kFine + 0.5) / kFine) / kPhi;
          expected[b] += u * u * u * sampled().response(node, kind, u, phi).row(0).dot(s.transpose());
        }
      }
      double total = 0.0;
      for (const double e : expected) total += e;
      for (double& e : expected) e *= kSamples / total;
      core::PhotonRng rng({20260111, stream++, 0}, 0);
      for (std::size_t i = 0; i < kSamples; ++i) {
        const SampledMueller::Draw d = sampled().draw(node, s, rng);
        double phi = std::atan2(d.sin_phi, d.cos_phi);
        if (phi < 0.0) phi += 2.0 * core::kPi;
        const auto iu = std::min(static_cast<std::size_t>(d.u * kU), kU - 1);
        const auto iphi = std::min(static_cast<std::size_t>(phi / (2.0 * core::kPi) * kPhi), kPhi - 1);
        counts[(static_cast<std::size_t>(d.kind) * kPhi + iphi) * kU + iu] += 1.0;
      }
      EXPECT_GT(tests::chi_square_test(counts, expected).p_value, 1.7e-4) << "node " << node;
    }
  }
}

TEST(SampledMueller, TotalsOfAnyPolarizationAreAtMostOne) {
  const IncidenceGrid& grid = sampled().incidences();
  for (std::size_t node = 0; node < grid.size(); ++node) {
    const Eigen::Vector4d t = sampled().integral(node);
    EXPECT_LE(t[0] + t.tail<3>().norm(), 1.0 + 1e-6);
  }
  EXPECT_FALSE(sampled().remarks().empty()) << "this film had to be scaled down";
  EXPECT_LT(sampled().bytes(), 60u << 20);
}

TEST(SampledMueller, MeetsTheHemisphericalTotals) {
  const MuellerTable table(tests::mueller_of(BsdfTable::read(tests::data_file("dbef.csv")), false));
  const auto totals = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  const SampledMueller bsdf(table, 550.0, &totals, 1.58);
  for (std::size_t node = 0; node < bsdf.incidences().size(); node += 5) {
    const double sigma = bsdf.incidences().sigma(node), psi = bsdf.incidences().psi(node);
    if (sigma > 60.5 * tests::kRad) continue;
    const auto chi = pass_axis(std::cos(psi), std::sin(psi), std::sin(sigma), 1.58);
    const Eigen::Vector4d seen(1.0, chi.cos2 * std::cos(2 * psi) + chi.sin2 * std::sin(2 * psi),
                               chi.sin2 * std::cos(2 * psi) - chi.cos2 * std::sin(2 * psi), 0.0);
    EXPECT_NEAR(bsdf.integral(node, ScatterKind::transmission).dot(seen), totals.at(sigma).transmittance_pass, 2e-5);
    EXPECT_NEAR(bsdf.integral(node, ScatterKind::reflection).dot(seen), totals.at(sigma).reflectance_pass, 2e-5);
  }
}

}  // namespace
}  // namespace evenglow::tracer
