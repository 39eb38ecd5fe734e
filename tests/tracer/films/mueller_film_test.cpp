#include "tracer/films/mueller_film.h"

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"

namespace evenglow::tracer {
namespace {

using tests::FilmBins;
using tests::kRad;
using tests::test_lights;
using tests::travel;

const BsdfTable& dbef_table() {
  static const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  return table;
}

const HemisphericalTable& totals() {
  static const auto table = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  return table;
}

constexpr double kAxis = 0.4;

/// The film of the DBEF data by its matrices, and by tau_min, tau_max, delta.
const TabulatedMueller& by_matrices() {
  static const MuellerTable table(tests::mueller_of(dbef_table(), false));
  static const TabulatedMueller film(table, 550.0, &totals(), kAxis);
  return film;
}

const TabulatedDbef& by_table() {
  static const TabulatedDbef film = tests::data_dbef(kAxis);
  return film;
}

struct Case {
  double sigma, azimuth;
  bool up;
};
constexpr Case kCases[] = {{0, 0, false}, {20, 52, true}, {45, 130, false}, {60, 200, false}, {75, 310, true}};

/// Mueller matrix (tangential count) from four lights.
core::MuellerMatrix mueller(const Bsdf& film, const core::Vec3& k, const core::Vec3& k_out) {
  const TangentialFrame in = tangential_frame(k);
  const auto out = [&](const Eigen::Vector4d& s) {
    return to_film(film.evaluate(from_film(s, in), k_out), tangential_frame(k_out));
  };
  core::MuellerMatrix M;
  M.col(0) = out({1, 0, 0, 0});
  for (int i = 1; i < 4; ++i) {
    Eigen::Vector4d s(1, 0, 0, 0);
    s[i] = 0.5;
    M.col(i) = 2.0 * (out(s) - M.col(0));
  }
  return M;
}

TEST(TabulatedMueller, HasTheHemisphericalValuesOfTheSameFilm) {
  for (const Case& c : kCases) {
    const core::Vec3 k = travel(c.sigma, c.azimuth, c.up);
    for (const core::StokesVector& light : test_lights(k)) {
      for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
        EXPECT_NEAR(by_matrices().hemispherical(light, kind), by_table().hemispherical(light, kind), 2e-3)
            << "sigma " << c.sigma;
      }
    }
  }
}

TEST(TabulatedMueller, HasItsOwnTotalsWithoutAHemisphericalTable) {
  const MuellerTable table(tests::mueller_of(dbef_table(), false));
  const TabulatedMueller own(table, 550.0, nullptr, kAxis);
  const TabulatedDbef other(dbef_table(), 550.0, nullptr, kAxis);
  for (const Case& c : kCases) {
    for (const core::StokesVector& light : test_lights(travel(c.sigma, c.azimuth, c.up))) {
      for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
        EXPECT_NEAR(own.hemispherical(light, kind), other.hemispherical(light, kind), 2e-3);
      }
    }
  }
}

TEST(TabulatedMueller, IsTheSameFilmDirectionByDirection) {
  double difference = 0.0, power = 0.0, sum = 0.0, total = 0.0;
  for (const Case& c : kCases) {
    const core::Vec3 k = travel(c.sigma, c.azimuth, c.up);
    const FilmBins bins(k);
    for (const core::StokesVector& light : test_lights(k)) {
      const auto a = bins.integrals(by_matrices(), light), b = bins.integrals(by_table(), light);
      for (std::size_t i = 0; i < FilmBins::kCount; ++i) {
        difference += (a[i] - b[i]).norm();
        sum += b[i].norm();
        power += std::abs(a[i][0] - b[i][0]);
        total += b[i][0];
      }
    }
  }
  // Interpolation error alone: the table of matrices turns its axes linearly between nodes, the other one by formula.
  EXPECT_LT(power / total, 0.002);
  EXPECT_LT(difference / sum, 0.02);
}

/// Directions of the samples against the other film's density. Chance of a false alarm 1e-3, over 25 tests: 4e-5 each.
TEST(TabulatedMueller, DrawsTheDirectionsOfTheSameFilm) {
  constexpr std::size_t kSamples = 20000;
  std::uint32_t stream = 0;
  for (const Case& c : kCases) {
    const core::Vec3 k = travel(c.sigma, c.azimuth, c.up);
    const FilmBins bins(k);
    for (const core::StokesVector& light : test_lights(k)) {
      std::vector<double> counts(FilmBins::kCount, 0.0), expected(FilmBins::kCount, 0.0);
      core::PhotonRng rng({20260105, stream++, 0}, 0);
      double scattered = 0.0, total = 0.0;
      for (std::size_t i = 0; i < kSamples; ++i) {
        const auto drawn = by_matrices().sample(light, rng);
        if (!drawn) continue;
        counts[bins.index(drawn->light.frame.k)] += 1.0;
        scattered += 1.0;
      }
      const auto integrals = bins.integrals(by_table(), light);
      for (const auto& s : integrals) total += s[0];
      for (std::size_t b = 0; b < FilmBins::kCount; ++b) expected[b] = integrals[b][0] / total * scattered;
      EXPECT_GT(tests::chi_square_test(counts, expected).p_value, 4e-5) << "sigma " << c.sigma;
      EXPECT_NEAR(scattered / kSamples, total, 4.3 * std::sqrt(total * (1.0 - total) / kSamples) + 2e-3);
    }
  }
}

TEST(TabulatedMueller, TheSampleIsWhatEvaluateTells) {
  core::PhotonRng rng({20260106, 0, 0}, 0);
  for (const Case& c : kCases) {
    const core::Vec3 k = travel(c.sigma, c.azimuth, c.up);
    for (const core::StokesVector& light : test_lights(k)) {
      for (int i = 0; i < 50; ++i) {
        const auto drawn = by_matrices().sample(light.scaled(3.0), rng);
        if (!drawn) continue;
        const auto told = by_matrices().evaluate(light, drawn->light.frame.k);
        EXPECT_EQ(drawn->light.I, 3.0);
        EXPECT_NEAR(drawn->light.Q, 3.0 * told.Q / told.I, 1e-9);
        EXPECT_NEAR(drawn->light.U, 3.0 * told.U / told.I, 1e-9);
        EXPECT_NEAR(drawn->light.V, 3.0 * told.V / told.I, 1e-9);
        EXPECT_FALSE(drawn->specular);
      }
    }
  }
}

TEST(TabulatedMueller, IsPhysicalInEveryDirection) {
  core::PhotonRng rng({20260107, 0, 0}, 0);
  for (const Case& c : kCases) {
    const core::Vec3 k = travel(c.sigma, c.azimuth, c.up);
    for (int i = 0; i < 200; ++i) {
      const double z = 2.0 * rng.uniform() - 1.0, phi = 2.0 * core::kPi * rng.uniform();
      const double r = std::sqrt(1.0 - z * z);
      const auto M = mueller(by_matrices(), k, core::Vec3(r * std::cos(phi), r * std::sin(phi), z));
      EXPECT_GT(core::least_coherency_eigenvalue(M), -1e-6);
    }
  }
}

// ---- Films whose law is known.

/// Flat scatter into the hemisphere of both kinds: total `share` each, with the matrix `shape` (shape(0, 0) = 1)
/// between film frames.
TabulatedMueller flat(double share, const core::MuellerMatrix& shape, double axis) {
  const MuellerTable table(
      tests::mueller_stored("flat.csv", {0, 1}, {{{0, 90}, {0, 60}, {0, 90, 180, 270}, {0, 10, 60, 90}, {550}}},
                            [&](const tests::NodeIndex&) -> core::MuellerMatrix { return share / core::kPi * shape; }));
  return TabulatedMueller(table, 550.0, nullptr, axis);
}

TEST(TabulatedMueller, ARetarderTurnsLinearIntoCircularLight) {
  const core::MuellerMatrix quarter = core::retarder(core::kPi / 2);
  const TabulatedMueller film = flat(0.4, quarter, kAxis);
  core::PhotonRng rng({20260108, 0, 0}, 0);
  for (const bool up : {false, true}) {
    const core::Vec3 k(0, 0, up ? 1 : -1);
    const TangentialFrame in = tangential_frame(k);
    // Linear at 45 degrees from the film's axis.
    const double angle = 2.0 * (kAxis + core::kPi / 4);
    const auto light = from_film({1.0, std::cos(angle), std::sin(angle), 0.0}, in);
    EXPECT_NEAR(film.hemispherical(light, ScatterKind::reflection), 0.4, 1e-5);
    for (int i = 0; i < 100; ++i) {
      const auto drawn = film.sample(light, rng);
      if (!drawn) continue;
      const Eigen::Vector4d s = to_film(drawn->light, tangential_frame(drawn->light.frame.k));
      EXPECT_NEAR(s[3], (quarter * Eigen::Vector4d(1, 0, 1, 0))[3], 1e-5);
    }
  }
}

TEST(TabulatedMueller, EnergyIsKeptForThePolarizationThatHasMost) {
  // A film that sends out only what is right circular: 0.8 (1 + V), so R + T reaches 3.2 for it and is scaled to 1.
  core::MuellerMatrix circular = core::MuellerMatrix::Zero();
  circular(0, 0) = circular(0, 3) = 1.0;
  const TabulatedMueller film = flat(0.8, circular, 0.0);
  ASSERT_EQ(film.remarks().size(), 2u);
  EXPECT_NE(film.remarks()[1].find("R + T above 1 at 288 of 288 incidences, scaled down by up to 68.75 %"),
            std::string::npos)
      << film.remarks()[1];
  const TangentialFrame in = tangential_frame(core::Vec3(0, 0, -1));
  const auto total = [&](double v) {
    const auto light = from_film({1.0, 0.0, 0.0, v}, in);
    return film.hemispherical(light, ScatterKind::reflection) + film.hemispherical(light, ScatterKind::transmission);
  };
  EXPECT_NEAR(total(1.0), 1.0, 1e-6);
  EXPECT_NEAR(total(0.0), 0.5, 1e-6);
  EXPECT_NEAR(total(-1.0), 0.0, 1e-6);
}

TEST(TabulatedMueller, FramesOfTheFileDoNotMatter) {
  // The same film counted from the rays' e1 and from the film's axis; at the nodes themselves both are exact.
  const MuellerTable film(tests::mueller_of(dbef_table(), false)), laboratory(tests::mueller_of(dbef_table(), true));
  EXPECT_EQ(film.frames(), AngleOrigin::film);
  EXPECT_EQ(laboratory.frames(), AngleOrigin::laboratory);
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const auto a = film.slice(kind, 45 * kRad, 30 * kRad, 550), b = laboratory.slice(kind, 45 * kRad, 30 * kRad, 550);
    for (const double phi : {0.0, 45.0, 100.0, 315.0}) {
      for (const double theta : {0.0, 4.0, 33.0}) {
        EXPECT_LT((a.at(phi * kRad, theta * kRad) - b.at(phi * kRad, theta * kRad)).norm(),
                  1e-9 * a.at(phi * kRad, theta * kRad).norm());
      }
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer
