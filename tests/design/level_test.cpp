#include "design/updaters/level.h"

#include <gtest/gtest.h>

#include "design/problem/design_spec.h"

namespace evenglow::design {
namespace {

tracer::DensityField density_of(const std::vector<double>& values) {
  const auto count = static_cast<int>(values.size());
  tracer::DensityField density;
  density.cells = {core::CellGrid::over(count, 1, 0, 0, count, 1), 0.0};
  density.cells.values = values;
  return density;
}

DesignSpec limits(double least, double largest) {
  DesignSpec spec;
  spec.density_min = least;
  spec.density_max = largest;
  return spec;
}

TEST(Level, OfTheStepBeforeIsKeptWhateverTheShapesScale) {
  const Proposal proposal = with_level(density_of({1.0, 2.0, 3.0}), 0.2, limits(0.01, 0.8));
  EXPECT_NEAR(proposal.density.cells.mean(), 0.2, 1e-15);
  EXPECT_NEAR(proposal.density.cells.values[2] / proposal.density.cells.values[0], 3.0, 1e-12);
  EXPECT_NEAR(proposal.level_change, 1.0, 1e-12);
  EXPECT_EQ(proposal.clipped_low + proposal.clipped_high, 0);
}

TEST(Level, IsThatOfTheRunFileIfItIsFixed) {
  DesignSpec spec = limits(0.01, 0.8);
  spec.level = 0.3;
  const Proposal proposal = with_level(density_of({1.0, 2.0, 3.0}), 0.2, spec);
  EXPECT_NEAR(proposal.density.cells.mean(), 0.3, 1e-15);
  EXPECT_NEAR(proposal.level_change, 1.5, 1e-12);
}

TEST(Level, GivesWayToAFullCellButNotByMoreThanAFifth) {
  const Proposal near = with_level(density_of({0.5, 0.5, 0.85}), 1.85 / 3.0, limits(0.01, 0.8));
  EXPECT_NEAR(near.density.cells.values[2], 0.97 * 0.8, 1e-12);
  EXPECT_EQ(near.clipped_high, 0);
  const Proposal far = with_level(density_of({0.1, 0.1, 2.0}), 2.2 / 3.0, limits(0.01, 0.8));
  EXPECT_NEAR(far.density.cells.values[0], 0.08, 1e-12);
  EXPECT_EQ(far.clipped_high, 1);
  EXPECT_DOUBLE_EQ(far.density.cells.values[2], 0.8);
}

TEST(Level, CellsAtALimitAreCounted) {
  const Proposal proposal = with_level(density_of({0.001, 0.002, 0.6, 0.197}), 0.2, limits(0.01, 0.8));
  EXPECT_EQ(proposal.clipped_low, 2);
  EXPECT_EQ(proposal.clipped_high, 0);
  EXPECT_DOUBLE_EQ(proposal.density.cells.values[0], 0.01);
}

TEST(Level, TheShapeIsMadeSymmetricAndItsSlopesBoundedIfThatIsWished) {
  DesignSpec spec = limits(0.01, 0.8);
  spec.symmetry = std::string(1, 'x');
  const auto mirrored = with_level(density_of({0.1, 0.2, 0.3}), 0.2, spec).density.cells.values;
  EXPECT_DOUBLE_EQ(mirrored[0], mirrored[2]);
  spec.symmetry = "none";
  spec.neighbor_ratio = 1.5;
  const auto smooth = with_level(density_of({0.1, 0.3, 0.1}), 0.2, spec).density.cells.values;
  EXPECT_LE(smooth[1] / smooth[0], 1.5 * (1.0 + 1e-12));
}

}  // namespace
}  // namespace evenglow::design
