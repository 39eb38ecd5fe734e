#include "tracer/sources/emission_pattern.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/chi_square.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::kPi;
using core::Vec3;

constexpr int kTheta = 11;
constexpr int kPhi = 13;

/// A lopsided table without any symmetry; its steps differ.
IntensityTable lopsided() {
  const std::vector<double> theta{0.0, 0.2, 0.35, 0.8, 1.3, 0.5 * kPi};
  const std::vector<double> phi{0.0, 0.9, 2.0, 3.3, 5.0, 2.0 * kPi};
  std::vector<double> values;
  for (const double p : phi) {
    for (const double t : theta) values.push_back(std::max(0.0, 1.0 + 0.7 * std::sin(p) * t - 0.5 * t * std::cos(p)));
  }
  return whole_circle(theta, phi, values, AzimuthSymmetry::kNone);
}

/// Expected share of each bin: midpoint rule over `intensity`, which the sampling does not use.
std::vector<double> shares(const IntensityTable& table, double turn) {
  constexpr int kFine = 40;
  std::vector<double> result(kTheta * kPhi, 0.0);
  double sum = 0.0;
  for (int i = 0; i < kTheta * kFine; ++i) {
    const double t = (i + 0.5) * 0.5 * kPi / (kTheta * kFine);
    for (int j = 0; j < kPhi * kFine; ++j) {
      const double p = (j + 0.5) * 2.0 * kPi / (kPhi * kFine);
      double from = std::fmod(p - turn + 4.0 * kPi, 2.0 * kPi);
      const double f = table.intensity(t, from) * std::sin(t);
      result[static_cast<std::size_t>(i / kFine * kPhi + j / kFine)] += f;
      sum += f;
    }
  }
  for (double& share : result) share /= sum;
  return result;
}

std::size_t bin(const Vec3& k, const Vec3& right, const Vec3& up, const Vec3& ahead) {
  const double t = std::acos(std::min(1.0, k.dot(ahead)));
  double p = std::atan2(k.dot(up), k.dot(right));
  if (p < 0.0) p += 2.0 * kPi;
  const int i = std::min(kTheta - 1, static_cast<int>(t / (0.5 * kPi) * kTheta));
  const int j = std::min(kPhi - 1, static_cast<int>(p / (2.0 * kPi) * kPhi));
  return static_cast<std::size_t>(i * kPhi + j);
}

TEST(EmissionPattern, TablesAreSampledByTheirIntensityAtEverySide) {
  const double turn = 0.7;
  const EmissionPattern pattern = EmissionPattern::tabulated(lopsided(), turn, true);
  std::vector<double> expected = shares(lopsided(), turn);
  constexpr int kSamples = 200000;
  for (double& share : expected) share *= kSamples;
  struct Case {
    Side side;
    Vec3 right, up, ahead;  // as seen from behind the source
  };
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  const Case cases[] = {{Side::kLeft, -y, z, x},  {Side::kRight, y, z, -x},  {Side::kFront, x, z, y},
                        {Side::kBack, -x, z, -y}, {Side::kBottom, -x, y, z}, {Side::kTop, x, y, -z}};
  for (const Case& c : cases) {
    core::PhotonRng rng({20260105, 0, 0}, static_cast<std::uint64_t>(c.side));
    std::vector<double> counts(expected.size(), 0.0);
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 k = pattern.sample(rng, side_axes(c.side));
      ASSERT_NEAR(k.norm(), 1.0, 1e-12);
      ASSERT_GT(k.dot(c.ahead), 0.0);
      counts[bin(k, c.right, c.up, c.ahead)] += 1.0;
    }
    EXPECT_GT(chi_square_test(counts, expected).p_value, sidak(1e-3, 6)) << side_name(c.side);
  }
}

TEST(EmissionPattern, TellsItsFluxAndWhatIsLeftOut) {
  const IntensityTable sphere = whole_circle({0.0, kPi}, {0.0}, {3, 3}, AzimuthSymmetry::kRotation);
  const EmissionPattern pattern = EmissionPattern::tabulated(sphere, 0.0, true);
  EXPECT_NEAR(pattern.flux().value(), 6.0 * kPi, 1e-9);
  EXPECT_NEAR(pattern.left_out(), 0.5, 1e-9);
  EXPECT_FALSE(EmissionPattern::tabulated(sphere, 0.0, false).flux());
  EXPECT_FALSE(EmissionPattern::cosine_power(2.0).flux());
}

TEST(EmissionPattern, RefusesATableWithoutLightAhead) {
  const IntensityTable behind = whole_circle({0.5 * kPi, kPi}, {0.0}, {1, 1}, AzimuthSymmetry::kRotation);
  const IntensityTable dark = whole_circle({0.0, kPi}, {0.0}, {0, 0}, AzimuthSymmetry::kRotation);
  EXPECT_THROW(EmissionPattern::tabulated(behind, 0.0, true), core::Error);
  EXPECT_THROW(EmissionPattern::tabulated(dark, 0.0, true), core::Error);
}

/// A spike between zeros: no sample falls where the intensity is zero.
TEST(EmissionPattern, DarkCellsStayDark) {
  const IntensityTable spike =
      whole_circle({0.0, 0.4, 0.5, 0.6, 1.5}, {0.0}, {0, 0, 1, 0, 0}, AzimuthSymmetry::kRotation);
  const EmissionPattern pattern = EmissionPattern::tabulated(spike, 0.0, true);
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 10000; ++i) {
    const double t = std::acos(pattern.sample(rng, side_axes(Side::kLeft)).x());
    ASSERT_TRUE(t > 0.4 - 1e-9 && t < 0.6 + 1e-9) << t;
  }
}

}  // namespace
}  // namespace evenglow::tests
