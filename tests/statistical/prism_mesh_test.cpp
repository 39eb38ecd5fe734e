#include "tests/support/prism_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/montecarlo/batches.h"
#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tracer/films/bef.h"

/// The film traced in its cross-section against the same prisms as an explicit mesh. Both are counted in the same
/// cells, and the counts compared by the chi-square of two samples. Seeds are fixed.
namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
using tracer::PrismFilm;
using tracer::PrismFilmSpec;

constexpr double kRad = core::kRadPerDeg;

/// A photon's incidence: side, angle from the normal in one of 17 strata of 5 degrees, one of the five test lights.
/// Cells of what comes out: side, direction cosine across the grooves (the one along them is that of the incident
/// light), and whether the light passed an ideal analyzer of a random kind, so that the counts hold its polarization.
class Experiment {
 public:
  explicit Experiment(double azimuth_deg) : azimuth_(azimuth_deg) {}

  template <typename Trace>
  std::vector<double> counts(std::uint64_t photons, std::uint32_t stream, int threads, const Trace& trace) const {
    constexpr std::uint64_t kBatch = 20'000;
    std::vector<double> total(kCells + 1, 0.0);
    std::mutex mutex;
    core::run_batches(photons / kBatch, threads, [&](std::size_t batch) {
      std::vector<double> own(kCells + 1, 0.0);
      for (std::uint64_t i = 0; i < kBatch; ++i) {
        core::PhotonRng rng({20, stream, 0}, batch * kBatch + i);
        own[one(rng, trace)] += 1.0;
      }
      const std::lock_guard lock(mutex);
      for (std::size_t c = 0; c <= kCells; ++c) total[c] += own[c];
    });
    return total;
  }

  static constexpr std::size_t kStrata = 17, kLights = 5, kAcross = 25, kAnalyzers = 6;
  static constexpr std::size_t kCells = 2 * kStrata * kLights * 2 * kAcross * kAnalyzers;

 private:
  template <typename Trace>
  std::size_t one(core::PhotonRng& rng, const Trace& trace) const {
    const bool up = rng.uniform() < 0.5;
    const double angle = 85.0 * rng.uniform();
    const auto stratum = static_cast<std::size_t>(angle / 5.0);
    const auto which = static_cast<std::size_t>(kLights * rng.uniform());
    const auto light = test_lights(travel(angle, azimuth_, up))[which];
    const std::optional<StokesVector> out = trace(light, rng);
    if (!out) return kCells;
    const Vec3& k = out->frame.k;
    const auto s = tracer::to_film(*out, tracer::tangential_frame(k));
    const auto kind = static_cast<std::size_t>(3.0 * rng.uniform());
    const std::size_t analyzer =
        2 * kind + (2.0 * rng.uniform() < 1.0 + s[static_cast<Eigen::Index>(kind) + 1] / s[0] ? 1 : 0);
    const auto across = std::min(static_cast<std::size_t>((0.5 + 0.5 * k.y()) * kAcross), kAcross - 1);
    std::size_t cell = (up ? 1 : 0) * kStrata + stratum;
    cell = cell * kLights + which;
    cell = 2 * cell + (k.z() > 0.0 ? 1 : 0);
    return (cell * kAcross + across) * kAnalyzers + analyzer;
  }

  double azimuth_;
};

/// Two samples of the same size, without the last count (over the rim). Cells of fewer than 20 together are pooled.
ChiSquareResult compare(const std::vector<double>& a, const std::vector<double>& b) {
  ChiSquareResult result;
  double rest_a = 0.0, rest_b = 0.0;
  const auto add = [&](double x, double y) {
    result.statistic += (x - y) * (x - y) / (x + y);
    ++result.degrees;
  };
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    if (a[i] + b[i] >= 20.0) {
      add(a[i], b[i]);
    } else {
      rest_a += a[i];
      rest_b += b[i];
    }
  }
  if (rest_a + rest_b >= 20.0) add(rest_a, rest_b);
  --result.degrees;
  result.p_value = chi_square_tail(result.statistic, result.degrees);
  return result;
}

PrismFilmSpec film_spec(double apex_deg, double tip_flat, double tip_radius) {
  PrismFilmSpec spec;
  spec.profile = {1.0, apex_deg * kRad, tip_flat, tip_radius};
  spec.base = PrismMesh::Shape{}.base;
  return spec;
}

/// The film and the mesh, `photons` each, at one azimuth of incidence from the grooves.
void expect_same(const PrismFilmSpec& spec, const PrismMesh& mesh, double azimuth, std::uint64_t photons, int threads) {
  const PrismFilm film(spec);
  const Experiment experiment(azimuth);
  const auto a = experiment.counts(photons, 0, threads, [&](const StokesVector& light, core::PhotonRng& rng) {
    return film.trace(light, rng).light;
  });
  const auto b = experiment.counts(
      photons, 1, threads, [&](const StokesVector& light, core::PhotonRng& rng) { return mesh.trace(light, rng); });
  EXPECT_EQ(a.back(), 0.0);
  EXPECT_LT(b.back(), 3e-5 * static_cast<double>(photons) + 5.0);  // over the rim of the mesh
  const ChiSquareResult result = compare(a, b);
  const double ratio = result.statistic / result.degrees;
  std::printf("azimuth %2.0f: chi-square / degrees %.4f, %d degrees, p %.3f, over the rim %.0f\n", azimuth, ratio,
              result.degrees, result.p_value, b.back());
  EXPECT_GT(result.degrees, 1500) << azimuth;
  EXPECT_NEAR(ratio, 1.0, 0.08) << azimuth;
  EXPECT_GT(result.p_value, 1e-4) << azimuth;
}

PrismMesh mesh_of(std::vector<tracer::PrismPoint> border, int prisms = 800) {
  PrismMesh::Shape shape;
  shape.border = std::move(border);
  shape.prisms = prisms;
  return PrismMesh(shape);
}

TEST(PrismMesh, SharpTips) {
  const PrismMesh mesh = mesh_of(PrismMesh::flat_border(0.0, 90 * kRad));
  for (const double azimuth : {0.0, 30.0, 90.0}) expect_same(film_spec(90, 0.0, 0.0), mesh, azimuth, 340'000, 1);
}

TEST(PrismMesh, FlatTips) {
  expect_same(film_spec(90, 0.2, 0.0), mesh_of(PrismMesh::flat_border(0.2, 90 * kRad)), 30.0, 200'000, 1);
}

TEST(PrismMesh, RoundTips) {
  // 400 chords: their normals differ by 0.2 degrees, far less than a cell.
  expect_same(film_spec(90, 0.0, 0.16), mesh_of(PrismMesh::round_border(0.16, 90 * kRad, 400), 300), 60.0, 200'000, 1);
}

TEST(PrismMesh, PrismsOfATurningFilm) {
  expect_same(film_spec(64, 0.0, 0.0), mesh_of(PrismMesh::flat_border(0.0, 64 * kRad)), 75.0, 200'000, 1);
}

TEST(PrismMesh, TheComparisonSeesADifference) {
  // An index of 1.57 for 1.58; grooves that are turned by half a degree.
  PrismFilmSpec spec = film_spec(90, 0.0, 0.0);
  const Experiment experiment(30.0);
  const auto counts = [&](const PrismFilmSpec& of, std::uint32_t stream) {
    const PrismFilm film(of);
    return experiment.counts(340'000, stream, 1, [&](const StokesVector& light, core::PhotonRng& rng) {
      return film.trace(light, rng).light;
    });
  };
  const auto base = counts(spec, 0);
  EXPECT_GT(compare(base, counts(spec, 1)).p_value, 1e-4);
  spec.refractive_index = 1.57;
  EXPECT_LT(compare(base, counts(spec, 1)).p_value, 1e-6);
  spec.refractive_index = 1.58;
  spec.axis = 0.5 * kRad;
  EXPECT_LT(compare(base, counts(spec, 1)).p_value, 1e-6);
}

TEST(PrismMeshLong, SharpTipsHundredMillionPhotons) {
  const PrismMesh mesh = mesh_of(PrismMesh::flat_border(0.0, 90 * kRad));
  for (const double azimuth : {0.0, 30.0, 90.0}) expect_same(film_spec(90, 0.0, 0.0), mesh, azimuth, 33'340'000, 2);
}

}  // namespace
}  // namespace evenglow::tests
