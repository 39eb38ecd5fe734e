#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"
#include "tests/support/z_test.h"
#include "tracer/films/dichroic_sheet.h"
#include "tracer/films/ideal_polarizer.h"
#include "tracer/films/lpp.h"
#include "tracer/films/mueller_film.h"
#include "tracer/films/scatter_table.h"
#include "tracer/films/tabulated_diffuser.h"
#include "tracer/films/wave_plate.h"
#include "tracer/films/wire_grid.h"

/// Every film's `sample` against its `evaluate` and `specular`. Seeds are fixed; the chance of a false alarm is 1e-3
/// for each film (each test of this file), Sidak-corrected over all its comparisons.
namespace evenglow::tests {
namespace {

using namespace tracer;

struct Incidence {
  double sigma, azimuth;
  bool up;
};

/// Sum of polarization (Q, U, V) / I of one outcome and of its squares.
struct Polarization {
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector4d& s) {
    const Eigen::Vector3d p = s.tail<3>() / s[0];
    n += 1.0;
    sum += p;
    squares += p.cwiseProduct(p);
  }
  double z(int i, double expected) const {
    const double mean = sum[i] / n;
    const double variance = std::max(0.0, squares[i] / n - mean * mean);
    // 1e-9: round-off of outcomes that all have the same state.
    return (mean - expected) / (std::sqrt(variance / n) + 1e-9);
  }
};

/// Outcomes: 0 absorbed; 1, 2 scattered down, up; 3, 4 specular down, up.
class SamplingCheck {
 public:
  SamplingCheck(const Bsdf& film, std::size_t samples, std::size_t comparisons)
      : film_(film), samples_(samples), chance_(sidak(1e-3, comparisons)), limit_(two_sided_z(chance_)) {}

  void run(const core::StokesVector& light, std::uint32_t stream) {
    const FilmBins bins(light.frame.k);
    std::vector<double> counts(FilmBins::kCount, 0.0);
    std::array<Polarization, 5> seen;
    core::PhotonRng rng({20260101, stream, 0}, 0);
    for (std::size_t i = 0; i < samples_; ++i) {
      const auto drawn = film_.sample(light, rng);
      if (!drawn) {
        seen[0].n += 1.0;
        continue;
      }
      const core::Vec3& k = drawn->light.frame.k;
      ASSERT_NEAR(drawn->light.I, light.I, 1e-9);
      ASSERT_LE(drawn->light.degree_of_polarization(), 1.0 + 1e-9);
      const bool up = k.z() > 0.0;
      seen[(drawn->specular ? 3 : 1) + (up ? 1 : 0)].add(to_film(drawn->light, tangential_frame(k)));
      if (!drawn->specular) counts[bins.index(k)] += 1.0;
    }
    compare(light, bins.integrals(film_, light), counts, seen);
  }

 private:
  void compare(const core::StokesVector& light, const std::vector<Eigen::Vector4d>& integrals,
               const std::vector<double>& counts, const std::array<Polarization, 5>& seen) {
    std::array<Eigen::Vector4d, 5> expected;
    expected.fill(Eigen::Vector4d::Zero());
    std::vector<double> share(FilmBins::kCount);
    for (std::size_t b = 0; b < FilmBins::kCount; ++b) {
      expected[b < FilmBins::kSide ? 1 : 2] += integrals[b];
      share[b] = integrals[b][0];
    }
    const TangentialFrame in = tangential_frame(light.frame.k);
    const Bsdf::Specular specular = film_.specular(light.frame.k);
    const bool up = light.frame.k.z() > 0.0;
    expected[up ? 4 : 3] = specular.transmission * to_film(light, in);
    expected[up ? 3 : 4] = specular.reflection * to_film(light, in);
    double left = 1.0;
    for (std::size_t o = 1; o < 5; ++o) left -= expected[o][0];
    EXPECT_GE(left, -1e-5) << "more light leaves than came";
    expected[0][0] = std::max(0.0, left);

    const auto n = static_cast<double>(samples_);
    for (std::size_t o = 0; o < 5; ++o) {
      const double p = std::clamp(expected[o][0], 0.0, 1.0);
      // The quadrature of `evaluate` has an error of its own, well below the standard error.
      const double z = (seen[o].n / n - p) / (std::sqrt(p * (1.0 - p) / n) + 2e-5);
      EXPECT_LT(std::abs(z), limit_) << "share of outcome " << o << ": " << seen[o].n / n << " for " << p;
      if (o == 0 || seen[o].n < 100.0) continue;
      for (int i = 0; i < 3; ++i) {
        EXPECT_LT(std::abs(seen[o].z(i, expected[o][i + 1] / expected[o][0])), limit_)
            << "polarization " << i << " of outcome " << o << ": " << seen[o].sum[i] / seen[o].n << " for "
            << expected[o][i + 1] / expected[o][0];
      }
    }
    const double scattered = seen[1].n + seen[2].n;
    if (scattered == 0.0) return;
    const double total = expected[1][0] + expected[2][0];
    for (double& s : share) s *= scattered / total;
    EXPECT_GT(chi_square_test(counts, share).p_value, chance_) << "directions";
  }

  const Bsdf& film_;
  std::size_t samples_;
  double chance_, limit_;
};

constexpr std::size_t kPerLight = 18;  ///< comparisons of one call of `run`: 5 shares, 12 means, 1 chi-square

void check(const Bsdf& film, const std::vector<Incidence>& incidences, std::size_t samples) {
  SamplingCheck sampling(film, samples, incidences.size() * 5 * kPerLight);
  std::uint32_t stream = 0;
  for (const Incidence& i : incidences) {
    for (const core::StokesVector& light : test_lights(travel(i.sigma, i.azimuth, i.up))) {
      SCOPED_TRACE(testing::Message() << "sigma " << i.sigma << " azimuth " << i.azimuth << " light " << stream % 5);
      sampling.run(light, stream++);
    }
  }
}

std::vector<Incidence> all_incidences() {
  std::vector<Incidence> all;
  for (const double sigma : {0.0, 20.0, 45.0, 60.0, 80.0}) {
    for (const double azimuth : {0.0, 52.0, 200.0}) all.push_back({sigma, azimuth, azimuth == 52.0});
  }
  return all;
}

std::vector<Incidence> few_incidences() {
  return {{0, 0, false}, {20, 52, true}, {60, 200, false}, {80, 310, false}};
}

TEST(FilmSampling, TabulatedDbef) {
  check(data_dbef(0.7), few_incidences(), 200000);
}

TEST(FilmSampling, TabulatedDbefWithItsOwnTotals) {
  const BsdfTable table = BsdfTable::read(data_file("dbef.csv"));
  check(TabulatedDbef(table, 550.0, nullptr, 0.7), {{20, 52, true}, {80, 310, false}}, 200000);
}

/// A film that does everything to polarization: diattenuation, retardance and depolarization that change with
/// direction, incidence and wavelength.
TEST(FilmSampling, TabulatedMueller) {
  const MuellerTable table(mueller_stored(
      "m.csv", {0, 1}, {{{0, 60, 120}, {0, 30, 60}, {0, 90, 180, 270}, {0, 10, 30, 80}, {450, 650}}},
      [](const NodeIndex& i) -> core::MuellerMatrix {
        const auto at = [&](std::size_t d) { return static_cast<double>(i[d]); };
        const double peak = (i[0] == 0 ? 0.9 : 1.3) * std::exp(-0.8 * at(4)) * (1.0 + 0.2 * std::cos(at(3)));
        return peak * (1.0 + 0.3 * at(5)) * core::rotator(0.4 * at(3)) * core::depolarizer(0.05 * at(4)) *
               core::retarder(0.5 + at(2) + 0.3 * at(1)) * core::rotator(0.2 * at(4)) *
               core::diattenuator(0.7, 0.1 + 0.2 * at(0)) * core::rotator(at(1) - 0.5 * at(5));
      }));
  check(TabulatedMueller(table, 520.0, nullptr, 0.7), few_incidences(), 200000);
}

TEST(FilmSampling, NarrowDiffuser) {
  check(Diffuser({0.7, 0.25, 0.8, 3.0 * kRad, 0.3}), few_incidences(), 200000);
}
TEST(FilmSampling, WideDiffuser) {
  check(Diffuser({0.7, 0.25, 0.8, 60.0 * kRad, 0.3}), few_incidences(), 200000);
}
TEST(FilmSampling, AbgDiffuser) {
  check(Diffuser({.transmittance = 0.7, .reflectance = 0.25, .haze = 0.8, .depolarization = 0.3, .abg = {{1e-2, 2.0}}}),
        few_incidences(), 200000);
}
TEST(FilmSampling, TabulatedDiffuser) {
  std::string text = "incidence_deg,theta_deg,phi_deg,btdf,brdf\n";
  for (const double sigma : {0, 40, 70}) {
    for (const double theta : {0, 5, 10, 20, 40, 70}) {
      for (const double phi : {0, 60, 120, 180}) {
        const double lobe = std::exp(-theta / 15.0) * (1.0 + 0.3 * (theta / 70.0) * std::cos(phi * kRad));
        text += fmt::format("{},{},{},{},{}\n", sigma, theta, phi, lobe, 0.3 * lobe * (1.0 + 0.01 * sigma));
      }
    }
  }
  check(TabulatedDiffuser(parse_scatter_table(text, "t.csv"), std::nullopt, 0.3), few_incidences(), 200000);
}
TEST(FilmSampling, LambertianDiffuser) {
  check(Diffuser({0.6, 0.3, 1.0, {}, 1.0}), few_incidences(), 200000);
}
TEST(FilmSampling, IdealDbef) {
  check(IdealPolarizer({0.9, 0.05, 0.1, 0.88}, 0.7, kDbefIndex), all_incidences(), 100000);
}
TEST(FilmSampling, Lpp) {
  check(lpp_surface({.axis = 0.7}), all_incidences(), 100000);
}

TEST(FilmSampling, LppSheetWithFaces) {
  check(DichroicSheet({0.8, 0.02, 0.7, 1.5, {}}), few_incidences(), 100000);
}
TEST(FilmSampling, WireGrid) {
  check(WireGrid({}, 0.7), few_incidences(), 100000);
}
TEST(FilmSampling, Retarder) {
  check(WavePlate({.retardance = 1.5, .fast_axis = 0.7}), few_incidences(), 100000);
}
TEST(FilmSampling, CarrierWithFaces) {
  check(WavePlate({40.0, 0.9, 0.7, 1.64, 0.05, true}), few_incidences(), 100000);
}

TEST(FilmSamplingLong, TabulatedDbef) {
  check(data_dbef(0.7), all_incidences(), 1000000);
}
TEST(FilmSamplingLong, NarrowDiffuser) {
  check(Diffuser({0.7, 0.25, 0.8, 3.0 * kRad, 0.3}), all_incidences(), 1000000);
}
TEST(FilmSamplingLong, WideDiffuser) {
  check(Diffuser({0.7, 0.25, 0.8, 60.0 * kRad, 0.3}), all_incidences(), 1000000);
}
TEST(FilmSamplingLong, NarrowAbgDiffuser) {
  check(Diffuser({.transmittance = 0.7, .reflectance = 0.25, .haze = 0.8, .depolarization = 0.3, .abg = {{1e-4, 1.5}}}),
        all_incidences(), 1000000);
}
TEST(FilmSamplingLong, LambertianDiffuser) {
  check(Diffuser({0.6, 0.3, 1.0, {}, 1.0}), all_incidences(), 1000000);
}

}  // namespace
}  // namespace evenglow::tests
