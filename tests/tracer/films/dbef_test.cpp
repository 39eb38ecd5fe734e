#include "tracer/films/dbef.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tracer/films/ideal_polarizer.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
using tests::travel;

core::MuellerMatrix mueller(const Bsdf& film, const core::Vec3& k, const core::Vec3& k_out) {
  // Columns from four lights; I must be positive, so (1, +Q) - (1, -Q) and so on.
  const TangentialFrame in = tangential_frame(k);
  const auto out = [&](const Eigen::Vector4d& s) {
    return to_film(film.evaluate(from_film(s, in), k_out), tangential_frame(k_out));
  };
  core::MuellerMatrix M;
  M.col(0) = out({1, 0, 0, 0});
  for (int i = 1; i < 4; ++i) {
    Eigen::Vector4d s(1, 0, 0, 0);
    s[i] = 1.0;
    M.col(i) = out(s) - M.col(0);
  }
  return M;
}

core::StokesVector along(const core::Vec3& k, double axis, bool block) {
  const TangentialFrame frame = tangential_frame(k);
  const double psi = axis - std::atan2(frame.azimuth_sin, frame.azimuth_cos);
  const AxisAngle chi = pass_axis(std::cos(psi), std::sin(psi), frame.sin_polar, kDbefIndex);
  const double sign = block ? -1.0 : 1.0;
  return from_film({1.0, sign * chi.cos2, sign * chi.sin2, 0.0}, frame);
}

TEST(IdealDbef, SplitsPassAndBlockLight) {
  const IdealPolarizer film({}, 0.4, kDbefIndex);
  for (const double sigma : {0.0, 30.0, 70.0}) {
    for (const bool up : {false, true}) {
      const core::Vec3 k = travel(sigma, 25.0, up);
      const auto specular = film.specular(k);
      const auto frame = tangential_frame(k);
      EXPECT_NEAR((specular.transmission * to_film(along(k, 0.4, false), frame))[0], 1.0, 1e-12);
      EXPECT_NEAR((specular.reflection * to_film(along(k, 0.4, false), frame))[0], 0.0, 1e-12);
      EXPECT_NEAR((specular.transmission * to_film(along(k, 0.4, true), frame))[0], 0.0, 1e-12);
      EXPECT_NEAR((specular.reflection * to_film(along(k, 0.4, true), frame))[0], 1.0, 1e-12);
      EXPECT_TRUE(core::is_physical(specular.transmission));
      EXPECT_TRUE(core::is_physical(specular.reflection));
    }
  }
}

TEST(IdealDbef, TransmittedFieldLiesAlongTheAxis) {
  const double axis = 0.4;
  const IdealPolarizer film({}, axis, kDbefIndex);
  core::PhotonRng rng({1, 0, 0}, 0);
  for (const bool up : {false, true}) {
    const core::Vec3 k(0, 0, up ? 1 : -1);
    const auto light = core::StokesVector::unpolarized(2.0, core::PolarizationFrame::any(k));
    for (int i = 0; i < 20; ++i) {
      const auto out = film.sample(light, rng);
      ASSERT_TRUE(out && out->specular);
      const bool passed = (out->light.frame.k.z() > 0) == up;
      const double field = passed ? axis : axis + core::kPi / 2;
      const auto s = out->light.in_frame(core::Vec3(std::cos(field), std::sin(field), 0));
      EXPECT_NEAR(s.Q, 2.0, 1e-12);
      EXPECT_NEAR(s.I, 2.0, 1e-12);
    }
  }
}

TEST(IdealDbef, RefusesGain) {
  EXPECT_THROW(IdealPolarizer({0.9, 0.2, 0.0, 1.0}, 0, 1.5), core::Error);
}

/// Mean |S of natural light / S of the table - 1| at the table's nodes up to 30 degrees from the axis and more than 5
/// degrees above the horizon, weighted by flux.
struct Deviation {
  double all = 0.0;    ///< as it is
  double shape = 0.0;  ///< against the table times one factor for each incidence and kind
};

Deviation deviation_at_nodes(const TabulatedDbef& film, const BsdfTable& table, double film_axis) {
  const auto& a = table.axes();
  double sum = 0.0, weights = 0.0, shape = 0.0;
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        // At normal incidence the azimuth would be lost, and psi with it.
        const core::Vec3 k = travel(std::max(a.sigma[s] / kRad, 1e-5), (film_axis - a.psi[p]) / kRad);
        const TangentialFrame in = tangential_frame(k);
        const double side = kind == ScatterKind::reflection ? 1.0 : -1.0;
        const core::Vec3 axis(k.x(), k.y(), side * std::abs(k.z()));
        const core::Vec3 h(in.azimuth_cos, in.azimuth_sin, 0);
        const core::Vec3 y(-in.azimuth_sin, in.azimuth_cos, 0);
        const core::Vec3 u = h * std::cos(a.sigma[s]) - core::Vec3(0, 0, side * std::sin(a.sigma[s]));
        std::vector<std::array<double, 3>> nodes;  // table, film, weight
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 1; t < a.theta.size() && a.theta[t] < 30.5 * kRad; ++t) {
            const core::Vec3 k_out =
                axis * std::cos(a.theta[t]) + (u * std::cos(a.phi[f]) + y * std::sin(a.phi[f])) * std::sin(a.theta[t]);
            if (side * k_out.z() < std::sin(5.0 * kRad)) continue;
            const auto& node = table.node(kind, p, s, f, t, 0);
            const double S = node.tau_min + node.tau_max;
            const double found =
                2.0 * film.evaluate(core::StokesVector::unpolarized(1.0, in.frame), k_out.normalized()).I;
            const double step = a.theta[std::min(t + 1, a.theta.size() - 1)] - a.theta[t - 1];
            nodes.push_back({S, found, S * std::abs(k_out.z()) * std::sin(a.theta[t]) * step});
          }
        }
        double expected = 0.0, total = 0.0;
        for (const auto& [S, found, weight] : nodes) {
          expected += weight;
          total += weight * found / S;
        }
        const double factor = total / expected;
        for (const auto& [S, found, weight] : nodes) {
          sum += weight * std::abs(found / S - 1.0);
          shape += weight * std::abs(found / (factor * S) - 1.0);
          weights += weight;
        }
      }
    }
  }
  return {sum / weights, shape / weights};
}

class TabulatedDbefTest : public testing::Test {
 protected:
  static constexpr double kAxis = 0.7;
  const TabulatedDbef film_ = tests::data_dbef(kAxis);
};

TEST_F(TabulatedDbefTest, HemisphericalValuesAreThoseOfTheTable) {
  const auto totals = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  double worst = 0.0;
  for (const double sigma : {0.0, 5.0, 20.0, 30.0, 45.0, 60.0, 80.0}) {
    for (const double psi : {0.0, 15.0, 45.0, 90.0, 150.0}) {
      const core::Vec3 k = travel(sigma, kAxis / kRad - psi, psi == 45.0);
      const auto row = totals.at(sigma * kRad);
      const auto error = [&](ScatterKind kind, bool block, double expected) {
        worst = std::max(worst, std::abs(film_.hemispherical(along(k, kAxis, block), kind) - expected));
      };
      error(ScatterKind::transmission, false, row.transmittance_pass);
      error(ScatterKind::transmission, true, row.transmittance_block);
      error(ScatterKind::reflection, false, row.reflectance_pass);
      error(ScatterKind::reflection, true, row.reflectance_block);
    }
  }
  EXPECT_LT(worst, 1e-4);
}

TEST_F(TabulatedDbefTest, HemisphericalValuesBetweenNodes) {
  const auto totals = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  for (const double sigma : {12.0, 37.0, 58.0}) {
    for (const double psi : {7.0, 52.0, 100.0}) {
      const core::Vec3 k = travel(sigma, kAxis / kRad - psi);
      const auto row = totals.at(sigma * kRad);
      EXPECT_NEAR(film_.hemispherical(along(k, kAxis, false), ScatterKind::transmission), row.transmittance_pass, 3e-3);
      EXPECT_NEAR(film_.hemispherical(along(k, kAxis, true), ScatterKind::transmission), row.transmittance_block, 2e-3);
      EXPECT_NEAR(film_.hemispherical(along(k, kAxis, true), ScatterKind::reflection), row.reflectance_block, 2e-3);
    }
  }
}

TEST_F(TabulatedDbefTest, IntegralsOfEvaluateAreTheHemisphericalValues) {
  for (const double sigma : {0.0, 33.0, 60.0, 80.0}) {
    const core::Vec3 k = travel(sigma, 77.0);
    for (const core::StokesVector& light : tests::test_lights(k)) {
      double down = 0.0, up = 0.0;
      const auto bins = tests::FilmBins(k).integrals(film_, light);
      for (std::size_t b = 0; b < bins.size(); ++b) (b < tests::FilmBins::kSide ? down : up) += bins[b][0];
      EXPECT_NEAR(down, film_.hemispherical(light, ScatterKind::transmission), 2e-5);
      EXPECT_NEAR(up, film_.hemispherical(light, ScatterKind::reflection), 2e-5);
      EXPECT_LE(down + up, 1.0 + 1e-6);
    }
  }
}

TEST_F(TabulatedDbefTest, FollowsTheTableAtItsNodes) {
  const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  const TabulatedDbef own(table, 550.0, nullptr, kAxis);
  const double resampling = deviation_at_nodes(own, table, kAxis).shape;
  const double all = deviation_at_nodes(film_, table, kAxis).all;
  std::printf("deviation at the nodes: %.2f %% by resampling, %.2f %% with the normalization\n", 100.0 * resampling,
              100.0 * all);
  EXPECT_LT(resampling, 0.02);
  EXPECT_LT(all, 0.04);
}

TEST_F(TabulatedDbefTest, PassesLightAlongItsAxisAndReflectsTheRest) {
  for (const double sigma : {0.0, 30.0, 60.0}) {
    for (const bool up : {false, true}) {
      const core::Vec3 k = travel(sigma, 77.0, up);
      const auto natural = core::StokesVector::unpolarized(1.0, tangential_frame(k).frame);
      for (const double to : {sigma, sigma + 6.0}) {
        const core::Vec3 through = travel(to, 80.0, up), back = travel(to, 80.0, !up);
        // Share of the light whose field lies along the pass axis that the outgoing ray sees.
        const auto pass_share = [&](const core::Vec3& k_out) {
          const auto out = film_.evaluate(natural, k_out);
          const auto pass = along(k_out, kAxis, false).in_frame(out.frame.e1);
          return 0.5 * (1.0 + (out.Q * pass.Q + out.U * pass.U) / out.I);
        };
        EXPECT_GT(pass_share(through), 0.9) << sigma;
        EXPECT_LT(pass_share(back), 0.25) << sigma;
      }
      // Light along either axis keeps its state.
      const auto kept = film_.evaluate(along(k, kAxis, false), k);
      EXPECT_NEAR(kept.in_frame(along(k, kAxis, false).frame.e1).Q / kept.I, along(k, kAxis, false).Q, 0.02);
    }
  }
}

TEST_F(TabulatedDbefTest, MatricesArePhysical) {
  for (const double sigma : {0.0, 17.0, 50.0, 85.0}) {
    for (const double out_sigma : {1.0, 20.0, 48.0, 75.0}) {
      for (const double azimuth : {0.0, 40.0, 170.0, 280.0}) {
        for (const bool up : {false, true}) {
          const auto M = mueller(film_, travel(sigma, 30.0), travel(out_sigma, azimuth, up));
          EXPECT_GT(M(0, 0), 0.0);
          EXPECT_TRUE(core::is_physical(M, 1e-9)) << core::least_coherency_eigenvalue(M);
        }
      }
    }
  }
}

/// M^T w by one table look-up, against the four columns of M from `evaluate`.
TEST_F(TabulatedDbefTest, PullsImportanceBackAsEvaluateSendsLight) {
  core::PhotonRng rng({3, 0, 0}, 0);
  const auto number = [&rng] { return 2.0 * rng.uniform() - 1.0; };
  for (int i = 0; i < 400; ++i) {
    const core::Vec3 k_in = travel(88.0 * rng.uniform(), 360.0 * rng.uniform(), i % 2 == 0);
    const core::Vec3 k_out = travel(88.0 * rng.uniform(), 360.0 * rng.uniform(), i % 4 < 2);
    const double angle = number();
    const auto any = core::PolarizationFrame::any(k_out);
    const core::PolarizationFrame frame{k_out, std::cos(angle) * any.e1 + std::sin(angle) * any.e2()};
    const core::StokesVector importance{1.0, number(), number(), number(), frame};
    const core::StokesVector back = film_.pulled_back(importance, k_in);
    const core::StokesVector light{1.0, 0.5 * number(), 0.5 * number(), 0.5 * number(),
                                   core::PolarizationFrame::any(k_in)};
    const core::StokesVector sent = film_.evaluate(light, k_out).in_frame(frame.e1);
    const double expected = sent.I + importance.Q * sent.Q + importance.U * sent.U + importance.V * sent.V;
    const core::StokesVector seen = light.in_frame(back.frame.e1);
    const double found = back.I + back.Q * seen.Q + back.U * seen.U + back.V * seen.V;
    ASSERT_NEAR(found, expected, 1e-12 * (1.0 + sent.I)) << i;
  }
}

TEST_F(TabulatedDbefTest, BelowIsTheMirrorImageOfAbove) {
  const core::Vec3 k = travel(40, 25), k_out = travel(30, 60, true);
  const auto flip = [](const core::Vec3& v) { return core::Vec3(v.x(), v.y(), -v.z()); };
  EXPECT_TRUE(mueller(film_, k, k_out).isApprox(mueller(film_, flip(k), flip(k_out)), 1e-9));
}

TEST_F(TabulatedDbefTest, TurningFilmAndLightTogetherChangesNothing) {
  const TabulatedDbef turned = tests::data_dbef(kAxis + 0.3);
  const auto here = mueller(film_, travel(40, 25), travel(30, 60, true));
  const auto there = mueller(turned, travel(40, 25 + 0.3 / kRad), travel(30, 60 + 0.3 / kRad, true));
  EXPECT_TRUE(here.isApprox(there, 1e-9));
}

TEST_F(TabulatedDbefTest, ReciprocityOfNaturalLightUpToTheTablesInterpolation) {
  // f(a -> b) = f(-b -> -a). Reversal turns the side too, but the film is the same from both. Weighted by f, over
  // directions within 25 degrees of the axis; the table itself, interpolated as its README says, reaches 4 to 5.5 % off
  // its nodes.
  double sum = 0.0, weights = 0.0;
  core::PhotonRng rng({5, 0, 0}, 0);
  for (int i = 0; i < 20000; ++i) {
    const double sigma = std::asin(std::sqrt(0.75 * rng.uniform())), azimuth = 2.0 * core::kPi * rng.uniform();
    const core::Vec3 k = travel(sigma / kRad, azimuth / kRad);
    const double d = 0.35 * std::sqrt(rng.uniform()), turn = 2.0 * core::kPi * rng.uniform();
    const double x = k.x() + d * std::cos(turn), y = k.y() + d * std::sin(turn);
    if (x * x + y * y > 0.75) continue;
    const core::Vec3 out(x, y, (i % 2 ? 1.0 : -1.0) * std::sqrt(1.0 - x * x - y * y));
    const auto f = [&](const core::Vec3& from, const core::Vec3& to) {
      return film_.evaluate(core::StokesVector::unpolarized(1.0, tangential_frame(from).frame), to).I;
    };
    const double there = f(k, out), back = f(-out, -k);
    sum += std::abs(there - back);
    weights += 0.5 * (there + back);
  }
  std::printf("reciprocity of natural light: mean deviation %.2f %%\n", 100.0 * sum / weights);
  RecordProperty("reciprocity_percent", std::to_string(100.0 * sum / weights));
  EXPECT_LT(sum / weights, 0.08);
}

TEST(TabulatedDbefLimits, ScalesDownWhatWouldCreateEnergyAndSaysSo) {
  // A flat table: S = 1 in both kinds gives pi/2 in each for natural light.
  const std::string text =
      "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n"
      "BRDF,0,0,0,0,550,0.5,0.5,0\nBTDF,0,0,0,0,550,0.5,0.5,0\n";
  const TabulatedDbef film(BsdfTable::parse(text, "flat.csv"), 550, nullptr, 0);
  ASSERT_EQ(film.remarks().size(), 2u);  // and that the data end at sigma = 0
  EXPECT_NE(film.remarks()[1].find("flat.csv: R + T above 1 at 288 of 288 incidences, scaled down by up to 68.17 %"),
            std::string::npos)
      << film.remarks()[1];
  const auto light = core::StokesVector::unpolarized(1, tangential_frame(travel(30, 0)).frame);
  EXPECT_NEAR(film.hemispherical(light, ScatterKind::reflection), 0.5, 1e-6);
}

TEST(TabulatedDbefLimits, FlatTableIsLambertianAtAnyIncidence) {
  const std::string text =
      "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\nBRDF,0,0,0,0,550,0.2,0.2,0\n";
  const TabulatedDbef film(BsdfTable::parse(text, "flat.csv"), 550, nullptr, 0);
  for (const double sigma : {0.0, 45.0, 80.0}) {
    const auto light = core::StokesVector::unpolarized(1, tangential_frame(travel(sigma, 11)).frame);
    EXPECT_NEAR(film.hemispherical(light, ScatterKind::reflection), 0.2 * core::kPi, 1e-4);
    EXPECT_EQ(film.evaluate(light, travel(20, 0)).I, 0.0);
  }
}

TEST(TabulatedDbefLimits, SaysWhenLobesAreTooNarrowForItsGrid) {
  std::string text = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";
  for (const char* row : {"0,550,1,100", "0.2,550,0.1,1", "0.4,550,0.0001,0.001", "60,550,0.00001,0.0001"}) {
    text += std::string("BRDF,0,0,0,") + row + ",0\n";
  }
  const TabulatedDbef film(BsdfTable::parse(text, "narrow.csv"), 550, nullptr, 0);
  ASSERT_EQ(film.remarks().size(), 2u);  // and that the data end at sigma = 0
  EXPECT_NE(film.remarks()[1].find("narrow.csv: lobes too narrow"), std::string::npos);
}

TEST(TabulatedDbefLimits, KappaDepolarizesRowsThreeAndFour) {
  const std::string text =
      "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg,kappa\n"
      "BRDF,0,0,0,0,550,0.1,0.2,0,0.5\n";
  const TabulatedDbef film(BsdfTable::parse(text, "flat.csv"), 550, nullptr, 0);
  const auto M = mueller(film, travel(0, 0), travel(1, 0, true));
  EXPECT_NEAR(M(3, 3) / M(0, 0), 0.5 * std::sqrt(0.02) / 0.15, 1e-3);
  EXPECT_TRUE(core::is_physical(M, 1e-9));
}

}  // namespace
}  // namespace evenglow::tracer
