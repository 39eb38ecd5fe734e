#include "design/engine/dot_verification.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "design/problem/regrid.h"
#include "tests/support/analytic_backlight.h"
#include "tracer/microstructure/dot_grid.h"

/// The closed loop on a backlight without photons, whose dots send out more light than their density says, the more the
/// farther from the light. Seeds are fixed; the figures stand far from their limits.
namespace evenglow::design {
namespace {

constexpr std::uint64_t kPhotons = 16'000'000;

/// The density model, or the dots by what of each cell they cover.
struct DottedBacklight {
  tests::AnalyticBacklight density_model;
  double excess = 0.2;  ///< of the dots at the far end

  std::optional<Observation> operator()(const tracer::DensityField& density, std::uint64_t photons,
                                        std::uint32_t step) const {
    if (!density.dots) return density_model(density, photons, step);
    const core::CellGrid& grid = density_model.grid;
    tracer::DensityField seen{density.dots->coverage(grid)};
    for (std::size_t i = 0; i < grid.size(); ++i)
      seen.cells.values[i] *= 1.0 + excess * static_cast<double>(i % 24) / 24.0;
    return density_model(seen, photons, step);
  }
};

struct Task {
  DottedBacklight backlight;
  ForwardModel model{backlight};
  DesignSpec spec;
  DotSpec dots;
  Margins margins;
  int threads = 1;

  Task() {
    spec.updater = "ratio";
    spec.stop_rms = 0.01;
    spec.density_min = 0.001;
    spec.density_max = 0.4;
    dots.mode = DotMode::both;
    dots.diameter_min = 0.04;
    dots.diameter_max = 0.1;
  }
  tracer::DensityField designed() const {
    const DesignLimits limits{200000, kPhotons};
    const tracer::DensityField flat{core::CellField(backlight.density_model.grid, 0.1)};
    return run_design(model, spec, limits, start_design(flat, spec, limits),
                      [](const StepRecord&, const DesignProgress&) {})
        .best_density;
  }
  std::optional<VerifiedDots> verified(
      const tracer::DensityField& density, const std::function<void(int)>& begins = [](int) {}) const {
    const RectangleZone face{0.0, 24.0, 0.0, 12.0};
    const DotVerification job{model, spec, dots, face, FreeArea(face, margins, {}, {}), 1.0, kPhotons, threads};
    return verify_dots(job, density, {1.0, 0.001}, {begins, [](const DotsRound&) {}});
  }
};

TEST(DotVerification, CorrectsWhatTheDotsDoOtherwise) {
  const Task task;
  const auto result = task.verified(task.designed());
  ASSERT_TRUE(result);
  const DotsJudgment& judgment = result->judgment;
  EXPECT_GT(judgment.rounds[0].record.rms_corrected.value, 0.03);
  EXPECT_LT(judgment.final.rms_corrected.value, 0.015);
  EXPECT_GE(judgment.chosen, 1U);
  EXPECT_EQ(judgment.rounds[judgment.chosen].dots, result->placement.dots.size());
  EXPECT_FALSE(judgment.stop_reason.empty());
  // The far end gets less.
  const tracer::DensityField designed = task.designed();
  EXPECT_LT(judgment.density.values[23] / designed.cells.values[23],
            0.95 * judgment.density.values[0] / designed.cells.values[0]);
}

/// A display whose cells are not those of the density: their borders cut through cells that hold what they must, and
/// on which side the dots stand is chance. Placing anew draws that chance anew; only other sizes on the same places
/// bring it down.
TEST(DotVerification, SizesMakeUpForChanceOfThePlaces) {
  Task task;
  tests::AnalyticBacklight display;
  display.grid = core::CellGrid::over(24, 12, 0.5, 0.5, 23.5, 11.5);
  task.model = ForwardModel([&](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
    return display({density.dots ? density.dots->coverage(display.grid) : regrid(density.cells, display.grid)}, photons,
                   step);
  });
  const auto result = task.verified(task.designed());
  ASSERT_TRUE(result);
  const DotsJudgment& judgment = result->judgment;
  EXPECT_GT(judgment.rounds[0].record.rms_corrected.value, 0.03);
  EXPECT_LT(judgment.final.rms_corrected.value, 0.015);
  for (const DotsRound& round : judgment.rounds) EXPECT_EQ(round.dots, judgment.rounds[0].dots);
}

TEST(DotVerification, SizesOfALatticeAreCorrectedToo) {
  Task task;
  task.dots.mode = DotMode::lattice;
  task.dots.diameter_min = 0.02;
  const auto result = task.verified(task.designed());
  ASSERT_TRUE(result);
  const DotsJudgment& judgment = result->judgment;
  EXPECT_GT(judgment.rounds[0].record.rms_corrected.value, 0.03);
  EXPECT_LT(judgment.final.rms_corrected.value, 0.015);
  EXPECT_EQ(judgment.rounds.back().dots, judgment.rounds[0].dots);
}

TEST(DotVerification, RoundsEndWhereTheRuleSays) {
  Task task;
  const tracer::DensityField density = task.designed();
  task.spec.verify_rounds = 0;
  const auto none = task.verified(density);
  ASSERT_EQ(none->judgment.rounds.size(), 1U);
  EXPECT_NE(none->judgment.stop_reason.find("verify_rounds"), std::string::npos) << none->judgment.stop_reason;
  EXPECT_EQ(none->judgment.density.values, density.cells.values);
  task.spec.verify_rounds = 3;
  task.spec.stop_rms = 0.2;  // even enough at once
  const auto at_once = task.verified(density);
  ASSERT_EQ(at_once->judgment.rounds.size(), 1U);
  EXPECT_NE(at_once->judgment.stop_reason.find("reached"), std::string::npos);
  task.spec.stop_rms = 1e-6;  // never
  task.spec.verify_rounds = 10;
  const auto until_no_gain = task.verified(density);
  EXPECT_LT(until_no_gain->judgment.rounds.size(), 11U);
  EXPECT_NE(until_no_gain->judgment.stop_reason.find("no gain"), std::string::npos);
  EXPECT_LT(until_no_gain->judgment.final.rms_corrected.value, 0.015);
}

/// A margin takes dots from the cells beside it; their density makes up for it.
TEST(DotVerification, MarginsAreMadeUpFor) {
  Task task;
  task.backlight.excess = 0.0;
  task.model = ForwardModel(task.backlight);
  task.margins.right = 0.3;
  const tracer::DensityField density = task.designed();
  const auto result = task.verified(density);
  ASSERT_TRUE(result);
  double before = 0.0, after = 0.0;
  for (std::size_t iy = 0; iy < 12; ++iy) {
    before += density.cells.values[24 * iy + 23];
    after += result->judgment.density.values[24 * iy + 23];
  }
  EXPECT_GT(after, 1.15 * before);
  EXPECT_LT(result->judgment.final.rms_corrected.value, 0.5 * result->judgment.rounds[0].record.rms_corrected.value);
}

TEST(DotVerification, SameOnAnyNumberOfThreadsAndJudgedByOtherNumbers) {
  Task task;
  const tracer::DensityField density = task.designed();
  const auto one = task.verified(density);
  task.threads = 3;
  const auto three = task.verified(density);
  EXPECT_EQ(one->placement.dots, three->placement.dots);
  EXPECT_EQ(one->judgment.luminance.values, three->judgment.luminance.values);
  EXPECT_NE(one->judgment.final.rms, one->judgment.rounds[one->judgment.chosen].record.rms);
}

TEST(DotVerification, AnInterruptionEndsIt) {
  Task task;
  const tracer::DensityField density = task.designed();
  for (const std::uint32_t last : {kVerifyingStep, kVerifiedStep}) {
    task.model = ForwardModel([&](const tracer::DensityField& field, std::uint64_t photons, std::uint32_t step) {
      return step == last ? std::nullopt : task.backlight(field, photons, step);
    });
    EXPECT_FALSE(task.verified(density));
  }
}

TEST(DotVerification, GreatestDensityIsWhatThePlacementHolds) {
  DotSpec dots;  // 60 um, gap 10 um
  EXPECT_NEAR(greatest_dot_density(dots, 1.0), 0.67 * 36.0 / 49.0, 0.001);
  EXPECT_NEAR(greatest_dot_density(dots, 0.5), 2.0 * 0.67 * 36.0 / 49.0, 0.002);
  dots.gap = 0.0;
  EXPECT_EQ(greatest_dot_density(dots, 0.5), 1.0);
}

}  // namespace
}  // namespace evenglow::design
