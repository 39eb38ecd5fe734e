#include "tests/support/path_agreement.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

constexpr double kThreeSigma = 0.0027;
constexpr int kManyCells = 1000;

}  // namespace

void expect_paths_agree(const std::string& name, const tracer::Scene& scene, const TwoPaths& paths,
                        const TraceSetup& setup, double chi_tolerance) {
  const PathDifference d = difference_of(scene, paths);
  const double per_cell = d.cells > 0 ? d.chi_square / d.cells : 1.0;
  EXPECT_LT(d.worst_z, z_limit(kThreeSigma, static_cast<std::size_t>(d.comparisons))) << name << ": " << d.worst_entry;
  if (d.cells > kManyCells) {
    EXPECT_NEAR(per_cell, 1.0, chi_tolerance) << name;
  }
  // The spread of a photon's number of events is about its mean: 8 / sqrt(photons) is more than 4 sigma.
  EXPECT_NEAR(d.events_ratio, 1.0, 8.0 / std::sqrt(static_cast<double>(setup.photons))) << name;
  std::printf("%-28s worst of %2d entries: %.2f sigma (%s); chi-square per cell %.3f of %d; events %.5f\n",
              name.c_str(), d.comparisons, d.worst_z, d.worst_entry.c_str(), per_cell, d.cells, d.events_ratio);
  std::fflush(stdout);  // hours may pass to the next
}

}  // namespace evenglow::tests
