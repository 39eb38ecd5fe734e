#include "tracer/polarized_bsdf/mueller_energy.h"

#include <gtest/gtest.h>

#include "tests/support/mueller_films.h"

namespace evenglow::tracer {
namespace {

/// Flat scatter with one matrix for all directions: its integral is pi times the matrix.
MuellerTable flat(const core::MuellerMatrix& M) {
  return MuellerTable(tests::mueller_stored("m.csv", {0}, {{{0, 90}, {0, 50}, {0, 90, 180, 270}, {0, 90}, {550}}},
                                            [&](const tests::NodeIndex&) { return M; }));
}

TEST(MuellerEnergy, FindsThePolarizationThatHasMost) {
  core::MuellerMatrix M = core::MuellerMatrix::Zero();
  M(0, 0) = 0.1;
  M(0, 1) = 0.02;
  M(0, 2) = -0.03;
  M(0, 3) = 0.06;  // |(2, 3, 6)| = 7
  const auto energies = mueller_energies(flat(M), 1.58);
  ASSERT_EQ(energies.size(), 4u);
  for (const IncidenceEnergy& e : energies) EXPECT_NEAR(e.greatest, core::kPi * 0.17, 1e-6);
}

TEST(MuellerEnergy, PassAndBlockLightOfALinearFilm) {
  const auto e = mueller_energies(flat(core::diattenuator(0.2, 0.05)), 1.58).front();
  EXPECT_NEAR(e.reflectance_pass, 0.2 * core::kPi, 1e-6);
  EXPECT_NEAR(e.reflectance_block, 0.05 * core::kPi, 1e-6);
  EXPECT_NEAR(e.greatest, 0.2 * core::kPi, 1e-6);
  EXPECT_EQ(e.transmittance_pass, 0.0);
}

}  // namespace
}  // namespace evenglow::tracer
