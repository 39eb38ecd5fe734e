#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"
#include "tests/support/chi_square.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

TEST(Statistics, ZLimitsAreThoseOfTables) {
  EXPECT_NEAR(two_sided_z(0.05), 1.959964, 1e-6);
  EXPECT_NEAR(two_sided_z(0.001), 3.290527, 1e-6);
  EXPECT_NEAR(sidak(0.05, 10), 0.005116197, 1e-9);
}

TEST(Statistics, ChiSquareTailsAreThoseOfTables) {
  EXPECT_NEAR(chi_square_tail(3.841459, 1), 0.05, 1e-7);
  EXPECT_NEAR(chi_square_tail(18.307038, 10), 0.05, 1e-7);
  EXPECT_NEAR(chi_square_tail(149.449253, 100), 0.001, 1e-8);
  EXPECT_NEAR(chi_square_tail(2.155856, 10), 0.995, 1e-6);
}

TEST(Statistics, ChiSquareAcceptsFairCountsAndRefusesOthers) {
  core::PhotonRng rng({11, 0, 0}, 0);
  std::vector<double> counts(50, 0.0);
  const std::vector<double> fair(50, 2000.0);
  for (int i = 0; i < 100000; ++i) counts[static_cast<std::size_t>(50.0 * rng.uniform())] += 1.0;
  EXPECT_GT(chi_square_test(counts, fair).p_value, 1e-3);  // false alarm 1e-3, seed fixed
  std::vector<double> tilted = fair;
  for (std::size_t i = 0; i < 50; ++i) tilted[i] *= i < 25 ? 1.03 : 0.97;
  EXPECT_LT(chi_square_test(counts, tilted).p_value, 1e-6);
}

TEST(Statistics, SmallBinsArePooled) {
  const std::array<double, 5> counts{100, 3, 2, 1, 94};
  const std::array<double, 5> expected{98, 2, 2, 2, 96};
  EXPECT_EQ(chi_square_test(counts, expected).degrees, 1);
}

}  // namespace
}  // namespace evenglow::tests
