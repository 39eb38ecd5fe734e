#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "core/montecarlo/batches.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/z_test.h"

/// Statement of the sampler: 1e8 photons a case, luminance of every (phi, theta) bin about the specular and the direct
/// axis against the integral of `evaluate` over that bin.
namespace evenglow::tracer {
namespace {

using tests::kRad;

constexpr std::size_t kPhi = 36, kTheta = 45;  // bins of 10 and 2 degrees
constexpr std::size_t kSide = kPhi * kTheta;
constexpr std::uint64_t kPhotons = 100'000'000;
constexpr std::size_t kBatches = 200;

/// Angles about the specular (up) or direct axis.
struct AxisBins {
  explicit AxisBins(double sigma) : s(std::sin(sigma)), c(std::cos(sigma)) {}

  std::size_t index(const core::Vec3& k) const {
    const double z = std::abs(k.z());
    const double along = k.x() * s + z * c, in_plane = k.x() * c - z * s;
    const double theta = std::atan2(std::hypot(in_plane, k.y()), along);
    double phi = std::atan2(k.y(), in_plane);
    if (phi < 0.0) phi += 2.0 * core::kPi;
    const auto it = static_cast<std::size_t>(theta / (2.0 * kRad));
    const auto ip = std::min(static_cast<std::size_t>(phi / (10.0 * kRad)), kPhi - 1);
    if (it >= kTheta) return 2 * kSide;  // more than 90 degrees off the axis: one bin for all
    return (k.z() > 0.0 ? 0 : kSide) + ip * kTheta + it;
  }

  /// Integral of evaluate x |cos| over each bin by midpoints, theta cut at the horizon.
  std::vector<double> integrals(const Bsdf& film, const core::StokesVector& light) const {
    constexpr int kParts = 24;
    std::vector<double> sums(2 * kSide, 0.0);
    for (std::size_t ip = 0; ip < kPhi; ++ip) {
      for (int a = 0; a < kParts; ++a) {
        const double phi = (static_cast<double>(ip) + (a + 0.5) / kParts) * 10.0 * kRad;
        const double horizon = std::atan2(c, std::cos(phi) * s);
        for (std::size_t it = 0; it < kTheta; ++it) {
          const double from = static_cast<double>(it) * 2.0 * kRad, to = std::min(from + 2.0 * kRad, horizon);
          for (int b = 0; b < kParts && to > from; ++b) {
            const double theta = from + (to - from) * (b + 0.5) / kParts;
            const double along = std::cos(theta), in_plane = std::sin(theta) * std::cos(phi);
            const core::Vec3 k(along * s + in_plane * c, std::sin(theta) * std::sin(phi), along * c - in_plane * s);
            const double area = std::sin(theta) * (to - from) / kParts * 10.0 * kRad / kParts * k.z();
            for (const double side : {1.0, -1.0}) {
              const core::Vec3 out = core::Vec3(k.x(), k.y(), side * k.z()).normalized();
              sums[(side > 0.0 ? 0 : kSide) + ip * kTheta + it] += area * film.evaluate(light, out).I;
            }
          }
        }
      }
    }
    return sums;
  }

  double s, c;
};

struct Counts {
  std::vector<double> bins;
  double reflected = 0.0, transmitted = 0.0;
};

Counts traced(const Bsdf& film, const core::StokesVector& light, const AxisBins& bins, std::uint64_t seed) {
  std::vector<Counts> parts(kBatches);
  core::run_batches(kBatches, 0, [&](std::size_t batch) {
    Counts& counts = parts[batch];
    counts.bins.assign(2 * kSide + 1, 0.0);
    const auto range = core::batch_range(batch, kBatches, kPhotons);
    for (std::uint64_t i = range.first; i < range.first + range.count; ++i) {
      core::PhotonRng rng({seed, 0, 0}, i);
      const auto out = film.sample(light, rng);
      if (!out) continue;
      (out->light.frame.k.z() > 0.0 ? counts.reflected : counts.transmitted) += 1.0;
      counts.bins[bins.index(out->light.frame.k)] += 1.0;
    }
  });
  Counts sum{std::vector<double>(2 * kSide + 1, 0.0), 0.0, 0.0};
  for (const Counts& part : parts) {
    for (std::size_t i = 0; i < sum.bins.size(); ++i) sum.bins[i] += part.bins[i];
    sum.reflected += part.reflected;
    sum.transmitted += part.transmitted;
  }
  return sum;
}

class DbefBinsLong : public testing::TestWithParam<double> {};

// 2400 to 3200 bins expect 20 photons or more: chi-square per degree of freedom has a spread below 0.03, so 1 +- 0.08
// is passed by chance once in 130 cases; R and T within 3 standard errors, once in 370 each. Together 13 % over nine
// cases on a new seed; the seeds are fixed.
TEST_P(DbefBinsLong, EveryBinHasItsLuminance) {
  const double sigma = GetParam() * kRad;
  const TabulatedDbef film = tests::data_dbef(25.0 * kRad);
  const core::Vec3 k = tests::travel(std::max(GetParam(), 1e-4), 0.0);
  const core::PolarizationFrame frame = tangential_frame(k).frame;
  const AxisBins bins(sigma);
  const core::StokesVector lights[] = {core::StokesVector::unpolarized(1.0, frame),
                                       core::StokesVector::linear(1.0, 25.0 * kRad, frame),
                                       core::StokesVector::linear(1.0, 1.4, frame)};
  std::uint64_t seed = 100 + static_cast<std::uint64_t>(GetParam());
  for (const core::StokesVector& light : lights) {
    const std::vector<double> shares = bins.integrals(film, light);
    const Counts counts = traced(film, light, bins, seed++);
    const auto n = static_cast<double>(kPhotons);
    double chi_square = 0.0;
    int degrees = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (n * shares[i] < 20.0) continue;
      chi_square += std::pow(counts.bins[i] - n * shares[i], 2) / (n * shares[i] * (1.0 - shares[i]));
      ++degrees;
    }
    const double R = film.hemispherical(light, ScatterKind::reflection);
    const double T = film.hemispherical(light, ScatterKind::transmission);
    const double z_R = tests::binomial_z(counts.reflected, n, R), z_T = tests::binomial_z(counts.transmitted, n, T);
    std::printf("sigma %.0f: chi-square / degrees of freedom %.1f / %d = %.3f, R %.4f (z %.2f), T %.4f (z %.2f)\n",
                GetParam(), chi_square, degrees, chi_square / degrees, R, z_R, T, z_T);
    EXPECT_GT(degrees, 1000);
    EXPECT_NEAR(chi_square / degrees, 1.0, 0.08);
    EXPECT_LT(std::abs(z_R), 3.0);
    EXPECT_LT(std::abs(z_T), 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Sigma, DbefBinsLong, testing::Values(0.0, 30.0, 60.0));

}  // namespace
}  // namespace evenglow::tracer
