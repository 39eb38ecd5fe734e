#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/optics/dielectric_face.h"

/// Stacks of N glass sheets against the incoherent closed form, s and p apart, natural light their mean. Counts are
/// binomial; seeds fixed; false alarm 1e-3 for each test, Sidak-corrected over its 2 x 72 (2 x 36) comparisons.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr double kIndex = 1.52, kThickness = 0.3, kPerMm = 0.4;

struct Shares {
  double T = 1.0, R = 0.0;
};

/// One sheet for one polarization from Fresnel's sine and tangent laws; `a`: share that survives one passage.
Shares one_sheet(double degrees, bool p, double a) {
  const double i = degrees * core::kRadPerDeg, t = std::asin(std::sin(i) / kIndex);
  double R = std::pow((kIndex - 1.0) / (kIndex + 1.0), 2);
  if (degrees > 0.0) R = std::pow(p ? std::tan(i - t) / std::tan(i + t) : std::sin(i - t) / std::sin(i + t), 2);
  const double T = (1.0 - R) * (1.0 - R) * a / (1.0 - R * R * a * a);
  return {T, R * (1.0 + a * T)};
}

Shares stack(int count, double degrees, bool p, double absorption) {
  const double t = std::asin(std::sin(degrees * core::kRadPerDeg) / kIndex);
  const Shares one = one_sheet(degrees, p, std::exp(-absorption * kThickness / std::cos(t)));
  Shares all;
  for (int n = 0; n < count; ++n) {
    const double many = 1.0 / (1.0 - all.R * one.R);
    all = {all.T * one.T * many, one.R + one.T * one.T * all.R * many};
  }
  return all;
}

TEST(StackOfPlates, ClosedFormsAgreeAmongThemselves) {
  for (const double degrees : {0.0, 40.0, 75.0}) {
    for (const bool p : {false, true}) {
      const double i = degrees * core::kRadPerDeg, t = std::asin(std::sin(i) / kIndex);
      double R = std::pow((kIndex - 1.0) / (kIndex + 1.0), 2);
      if (degrees > 0.0) R = std::pow(p ? std::tan(i - t) / std::tan(i + t) : std::sin(i - t) / std::sin(i + t), 2);
      for (const int count : {1, 2, 5}) {  // Stokes: (1 - R) / (1 + (2 N - 1) R)
        EXPECT_NEAR(stack(count, degrees, p, 0.0).T, (1.0 - R) / (1.0 + (2.0 * count - 1.0) * R), 1e-13);
      }
      const Bsdf::Specular sheet = incoherent_sheet(std::cos(i), kIndex, kPerMm, kThickness);
      const double sign = p ? 1.0 : -1.0;
      EXPECT_NEAR(sheet.transmission(0, 0) + sign * sheet.transmission(0, 1), stack(1, degrees, p, kPerMm).T, 1e-13);
      EXPECT_NEAR(sheet.reflection(0, 0) + sign * sheet.reflection(0, 1), stack(1, degrees, p, kPerMm).R, 1e-13);
    }
  }
}

void check_stacks(double absorption, std::uint64_t photons) {
  const double limit = z_limit(1e-3, 72);
  std::uint64_t seed = 1;
  for (const int count : {1, 2, 5}) {
    std::string films;
    for (int n = 0; n < count; ++n) {
      films += std::string(n > 0 ? ", " : "") + "{kind: sheet, refractive_index: " + text_of(kIndex) +
               ", thickness_mm: " + text_of(kThickness) + ", absorption_per_m: " + text_of(1000.0 * absorption) + "}";
    }
    for (const double degrees : {0.0, 40.0, 60.0, 75.0}) {
      for (const char* light : {"linear, azimuth_deg: 0", "linear, azimuth_deg: 90", "none"}) {
        const std::string polarization = light;
        Shares expected = stack(count, degrees,
                                polarization.back() == '0' && polarization[polarization.size() - 2] != '9', absorption);
        if (polarization == "none") {
          const Shares p = stack(count, degrees, true, absorption), s = stack(count, degrees, false, absorption);
          expected = {0.5 * (p.T + s.T), 0.5 * (p.R + s.R)};
        }
        const Traced traced("size: {length_mm: 400, width_mm: 400}, films: [" + films +
                                "], sources: [{kind: beam, size_share: 0.01, plane_deg: 25, angle_deg: " +
                                text_of(degrees) + ", polarization: " + polarization + "}]",
                            {photons, seed++, 10, 1});
        const auto where = testing::Message() << count << " sheets, " << degrees << " degrees, " << light;
        EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kTop), traced.photons(), expected.T)), limit) << where;
        EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kBottom), traced.photons(), expected.R)), limit) << where;
        EXPECT_EQ(traced.accounted(), traced.photons()) << where;
        EXPECT_EQ(traced.lost(), 0.0) << where;
        if (absorption == 0.0) {
          EXPECT_EQ(traced.escaped(Side::kTop) + traced.escaped(Side::kBottom), traced.photons()) << where;
        }
      }
    }
  }
}

TEST(StackOfPlates, Lossless) {
  check_stacks(0.0, 10'000);
}
TEST(StackOfPlates, Absorbing) {
  check_stacks(kPerMm, 10'000);
}
TEST(StackOfPlatesLong, Lossless) {
  check_stacks(0.0, 400'000);
}
TEST(StackOfPlatesLong, Absorbing) {
  check_stacks(kPerMm, 400'000);
}

}  // namespace
}  // namespace evenglow::tests
