#include "tracer/microstructure/traced_bump.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/bumps.h"
#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"

/// What holds for every clear shape. Seeds are fixed; false alarm 1e-3 for each test, over all its comparisons.
namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
constexpr double kIndex = 1.4938;

const std::vector<std::string> kShapes = {
    "kind: microlens, aspect: 0.5",
    "kind: microlens, aspect: 0.1, face: top",
    "kind: microlens, aspect: 0.3, form: sunk",
    "kind: cone, flank_deg: 60",
    "kind: cone, flank_deg: 45, truncation: 0.5",
    "kind: cone, aspect: 0.6, form: sunk",
    "kind: pyramid, flank_deg: 45, axis_deg: 20",
    "kind: pyramid, flank_deg: 70, truncation: 0.3, form: sunk",
    "kind: v_groove, axis_deg: 35",
    "kind: v_groove, flanks_deg: [20, 80], form: sunk",
    "kind: microlens, aspect: 0.4, form: sunk, fill: 0.2",
    "kind: cone, flank_deg: 60, fill: 0.5",
    "kind: pyramid, axis_deg: 50, form: sunk, fill: 0.3",
    "kind: v_groove, flanks_deg: [45, 60], fill: 0.4",
};

/// Light of unit radiance outside and n^2 inside, of this polarization (in the tangential frame).
StokesVector from_everywhere(core::PhotonRng& rng, const Eigen::Vector3d& state) {
  const bool from_inside = rng.uniform() < kIndex * kIndex / (1.0 + kIndex * kIndex);
  const double u1 = rng.uniform();
  Vec3 k = core::sample_lambertian(u1, rng.uniform());
  if (!from_inside) k.z() = -k.z();
  return {1.0, state[0], state[1], state[2], tracer::tangential_frame(k).frame};
}

/// Cells of equal etendue on one side: sin^2 of the polar angle, azimuth.
std::size_t cell_of(const Vec3& k, int polar_count, int azimuth_count) {
  const double sin2 = k.x() * k.x() + k.y() * k.y();
  const int polar = std::min(static_cast<int>(sin2 * polar_count), polar_count - 1);
  const double turns = std::atan2(k.y(), k.x()) / (2.0 * core::kPi) + 1.0;
  const int azimuth = static_cast<int>((turns - std::floor(turns)) * azimuth_count) % azimuth_count;
  return static_cast<std::size_t>(((k.z() > 0.0 ? 1 : 0) * polar_count + polar) * azimuth_count + azimuth);
}

/// A world in equilibrium stays in it: where natural light of radiance 1 outside and n^2 inside meets the structure,
/// as much leaves, with equal radiance in all directions, and natural. Nothing is absorbed.
void expect_equilibrium(int photons) {
  constexpr int kPolar = 10, kAzimuth = 16;
  constexpr std::size_t kCells = 2 * kPolar * kAzimuth;
  constexpr int kWide = 4;  // of the wide cells, in polar angle and azimuth, for the polarization
  constexpr std::size_t kWideCells = 2 * kWide * kWide;
  const double inside = kIndex * kIndex / (1.0 + kIndex * kIndex);
  const double chance = sidak(1e-3, 2 * kShapes.size());
  std::uint32_t stream = 0;
  for (const std::string& keys : kShapes) {
    const auto optics = optics_of(keys, kIndex);
    core::PhotonRng rng({20261122, ++stream, 0}, 0);
    std::vector<double> counts(kCells, 0.0);
    const std::vector<Eigen::Vector3d> zeros(kWideCells, Eigen::Vector3d::Zero());
    auto sums = zeros, squares = zeros, fourths = zeros;
    for (int i = 0; i < photons; ++i) {
      const auto out = optics->sample(from_everywhere(rng, Eigen::Vector3d::Zero()), rng);
      ASSERT_TRUE(out) << keys;
      const Vec3& k = out->light.frame.k;
      EXPECT_NEAR(k.norm(), 1.0, 1e-12);
      EXPECT_NEAR(k.dot(out->light.frame.e1), 0.0, 1e-12);
      const StokesVector light = out->light.in_frame(tracer::tangential_frame(k).frame.e1);
      EXPECT_EQ(light.I, 1.0);
      EXPECT_LT(light.degree_of_polarization(), 1.0 + 1e-9);
      counts[cell_of(k, kPolar, kAzimuth)] += 1.0;
      const std::size_t cell = cell_of(k, kWide, kWide);
      const Eigen::Vector3d s(light.Q, light.U, light.V);
      sums[cell] += s;
      squares[cell] += s.cwiseProduct(s);
      fourths[cell] += s.cwiseProduct(s).cwiseProduct(s).cwiseProduct(s);
    }
    std::vector<double> expected(kCells);
    for (std::size_t i = 0; i < kCells; ++i) {
      expected[i] = photons * (i < kCells / 2 ? inside : 1.0 - inside) / (kPolar * kAzimuth);
    }
    EXPECT_GT(chi_square_test(counts, expected).p_value, chance) << keys;
    double chi_square = 0.0, degrees = 0.0;
    for (std::size_t i = 0; i < kWideCells; ++i) {
      for (int j = 0; j < 3; ++j) {
        // Few polarized photons among many natural ones make no normal sum.
        if (squares[i][j] * squares[i][j] < 50.0 * fourths[i][j] || squares[i][j] < 1e-9) continue;
        chi_square += sums[i][j] * sums[i][j] / squares[i][j];
        degrees += 1.0;
      }
    }
    EXPECT_GT(degrees, kWideCells / 2) << keys;
    EXPECT_GT(chi_square_tail(chi_square, degrees), chance) << keys;
  }
}

TEST(TracedBump, KeepsTheThermalEquilibrium) {
  expect_equilibrium(100'000);
}

TEST(TracedBumpLong, KeepsTheThermalEquilibrium) {
  expect_equilibrium(5'000'000);
}

/// The flattest and the steepest shapes, the least fill, light along the normal, the axes and next to the horizon: it
/// comes out again, and is sound.
TEST(TracedBump, ExtremesLoseNothing) {
  const std::vector<std::string> shapes = {"kind: microlens, aspect: 0.0001",
                                           "kind: microlens, aspect: 0.5, fill: 0.01",
                                           "kind: cone, flank_deg: 0.1",
                                           "kind: cone, flank_deg: 85",
                                           "kind: cone, flank_deg: 85, truncation: 0.95, fill: 0.01",
                                           "kind: pyramid, flank_deg: 85",
                                           "kind: pyramid, flank_deg: 0.1, fill: 0.01",
                                           "kind: pyramid, aspect: 0.0001, truncation: 0.95",
                                           "kind: v_groove, flanks_deg: [85, 85]",
                                           "kind: v_groove, flanks_deg: [0.1, 85], fill: 0.01"};
  std::uint32_t stream = 200;
  for (const std::string& keys : shapes) {
    for (const std::string form : {"raised", "sunk"}) {
      const auto optics = optics_of(keys + ", form: " + form, 1.5);
      for (const double steep : {1.0, 0.1, 1e-3, 1e-6, 1e-9}) {
        for (const double azimuth : {0.0, 45.0, 90.0, 123.0}) {
          const double across = std::sqrt((1.0 - steep) * (1.0 + steep));
          // Exactly along the axes where the cosine or sine should be 0.
          const double x = azimuth == 90.0 ? 0.0 : across * std::cos(azimuth * core::kRadPerDeg);
          const double y = azimuth == 0.0 ? 0.0 : across * std::sin(azimuth * core::kRadPerDeg);
          for (const double side : {1.0, -1.0}) {
            const Vec3 k(x, y, side * steep);
            const StokesVector light = StokesVector::linear(1.0, 0.4, tracer::tangential_frame(k).frame);
            core::PhotonRng rng({20261122, ++stream, 0}, 0);
            for (int i = 0; i < (steep < 1e-4 ? 4 : 20); ++i) {
              const auto out = optics->sample(light, rng);
              // Within 1e-3 of the horizon (1e-6 of diffuse light) a photon may run out of cells.
              ASSERT_TRUE(out || steep < 1e-3) << keys << form << " " << k.transpose();
              if (!out) continue;
              const StokesVector& s = out->light;
              ASSERT_NEAR(s.frame.k.norm(), 1.0, 1e-12);
              ASSERT_NE(s.frame.k.z(), 0.0);
              ASSERT_NEAR(s.degree_of_polarization(), 1.0, 1e-6) << keys << form << " " << k.transpose();
            }
          }
        }
      }
    }
  }
}

/// Six states of polarization: linear along e1, e2, at +-45 degrees, circular; of the reversed ray, U has the other
/// sign (Helmholtz: M of the reversed path is the transpose with the signs of U turned).
Eigen::Vector3d state(std::size_t i) {
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  s[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0 : -1.0;
  return s;
}
std::size_t reversed_state(std::size_t i) {
  return i / 2 == 1 ? (i ^ 1u) : i;
}

/// Light from cell A in state a that arrives in cell B, as seen through an analyzer of state b, is as much as from B
/// reversed in state b that arrives in A reversed through an analyzer a.
void expect_reciprocity(int photons) {
  constexpr int kPolar = 3, kAzimuth = 4;
  constexpr std::size_t kCells = 2 * kPolar * kAzimuth, kStates = 6, kAll = kCells * kStates;
  const auto reversed = [](const Vec3& k) { return Vec3(-k.x(), -k.y(), k.z()); };  // on the same side: leaves as comes
  std::uint32_t stream = 100;
  double chi_square = 0.0, degrees = 0.0;
  for (const std::string& keys : kShapes) {
    const auto optics = optics_of(keys, kIndex);
    core::PhotonRng rng({20261122, ++stream, 0}, 0);
    std::vector<double> sums(kAll * kAll, 0.0), squares(kAll * kAll, 0.0);
    for (int i = 0; i < photons; ++i) {
      const std::size_t a = static_cast<std::size_t>(rng.uniform() * kStates);
      const StokesVector in = from_everywhere(rng, state(a));
      const auto out = optics->sample(in, rng);
      ASSERT_TRUE(out);
      const Vec3& k = out->light.frame.k;
      const StokesVector light = out->light.in_frame(tracer::tangential_frame(k).frame.e1);
      // From inside up and to inside down are the same place of the list: the cell of where the light is.
      const Vec3 side_in(in.frame.k.x(), in.frame.k.y(), -in.frame.k.z());
      const std::size_t from = cell_of(side_in, kPolar, kAzimuth) * kStates + a;
      for (std::size_t b = 0; b < kStates; ++b) {
        const std::size_t to = cell_of(reversed(k), kPolar, kAzimuth) * kStates + reversed_state(b);
        const double passed = 0.5 * (1.0 + Eigen::Vector3d(light.Q, light.U, light.V).dot(state(b)));
        sums[from * kAll + to] += passed;
        squares[from * kAll + to] += passed * passed;
      }
    }
    for (std::size_t i = 0; i < kAll; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t there = i * kAll + j, back = j * kAll + i;
        const double variance = squares[there] + squares[back];
        if (variance < 20.0) continue;
        chi_square += std::pow(sums[there] - sums[back], 2) / variance;
        degrees += 1.0;
      }
    }
  }
  EXPECT_GT(degrees, 1000.0);
  // The six analyzers see the same photons: up to three times the variance of independent terms.
  EXPECT_NEAR(chi_square / degrees, 1.0, two_sided_z(1e-3) * std::sqrt(3.0 * 2.0 / degrees));
}

TEST(TracedBump, IsReciprocal) {
  expect_reciprocity(200'000);
}

TEST(TracedBumpLong, IsReciprocal) {
  expect_reciprocity(5'000'000);
}

}  // namespace
}  // namespace evenglow::tests
