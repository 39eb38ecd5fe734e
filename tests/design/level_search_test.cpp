#include "design/engine/level_search.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"
#include "core/montecarlo/tally.h"

namespace evenglow::design {
namespace {

tracer::DensityField flat(double density) {
  return {core::CellField(core::CellGrid::over(4, 2, 0, 0, 4, 2), density)};
}

/// Efficiency 0.7 (1 - exp(-level / scale)) with noise of `se` at 1000 photons; of it the share `common` is the same at
/// all levels of a step, batch by batch.
ForwardModel saturating(double scale, double se = 1e-5, double common = 0.0, unsigned seed = 1) {
  return [=](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
    constexpr std::size_t kBatches = 50;
    std::mt19937_64 shared(seed * 7919ULL + step);
    std::mt19937_64 own(seed * 104729ULL + step * 31ULL + static_cast<std::uint64_t>(1e9 * density.cells.mean()));
    std::normal_distribution<double> normal_shared, normal_own;
    Observation observation;
    observation.photons = photons;
    const double truth = 0.7 * -std::expm1(-density.cells.mean() / scale);
    const double noise = se * std::sqrt(1000.0 / static_cast<double>(photons) * kBatches);
    std::vector<double> parts;
    for (std::size_t b = 0; b < kBatches; ++b) {
      const double one = std::sqrt(common) * normal_shared(shared) + std::sqrt(1.0 - common) * normal_own(own);
      observation.efficiency_batches.push_back(truth + noise * one);
      parts.push_back(observation.efficiency_batches.back() / kBatches);
    }
    observation.efficiency = core::total_of_batches(parts);
    return std::optional<Observation>(observation);
  };
}

/// The level at which 1 - exp(-l / scale) is 98 % of its value at `top`.
double knee(double scale, double top) {
  return -scale * std::log1p(-0.98 * -std::expm1(-top / scale));
}

double chosen(const ForwardModel& model, double start, const DesignSpec& spec = {}) {
  return start * choose_level(model, flat(start), spec, 1000, 1000000)->factor;
}

TEST(LevelSearch, TakesTheKneeBetweenTheLevelsItTried) {
  // Levels from 0.1 / 3 to 0.3: the knee lies anywhere, not at one of them.
  for (const double scale : {0.02, 0.04, 0.055}) {
    EXPECT_NEAR(chosen(saturating(scale), 0.1), std::max(0.1 / 3.0, knee(scale, 0.3)), 0.002) << scale;
  }
}

/// Up to 0.6, three quarters of the upper limit: wherever the search begins.
TEST(LevelSearch, GoesOnWhereTheKneeLiesBeyondTheLevelsItTried) {
  EXPECT_NEAR(chosen(saturating(0.2), 0.1), knee(0.2, 0.6), 0.004);
  // Where the range ends says a little about what is the best: 0.0743 to 0.0782.
  for (const double start : {0.004, 0.02, 0.3}) EXPECT_NEAR(chosen(saturating(0.02), start), 0.0763, 0.0025) << start;
}

TEST(LevelSearch, TellsThatALimitEndsTheRange) {
  DesignSpec spec;
  spec.density_max = 0.08;
  const auto choice = choose_level(saturating(0.2), flat(0.04), spec, 1000, 1000);
  EXPECT_NE(choice->note.find("still grows where the limits of the cells end the range"), std::string::npos)
      << choice->note;
  EXPECT_EQ(choice->note.find("lowest within 2 %"), std::string::npos);
}

TEST(LevelSearch, TellsThatNoLevelReachesTheEfficiency) {
  DesignSpec spec;
  spec.goal.kind = "min_rms";
  spec.goal.efficiency = 0.95;  // of a backlight that cannot give more than 0.7
  const auto choice = choose_level(saturating(0.04), flat(0.1), spec, 1000, 1000);
  EXPECT_NE(choice->note.find("no level that the limits of the cells allow reaches 95.0 %"), std::string::npos)
      << choice->note;
}

/// A few cells that a map keeps nearly bare do not hold the level of the others.
TEST(LevelSearch, CellsThatAMapHoldsAreNoBoundForTheOthers) {
  DesignSpec spec;
  spec.largest_map.nx = 4;
  spec.largest_map.ny = 2;
  spec.largest_map.values.assign(8, 0.8);
  spec.largest_map.values[3] = 0.02;
  tracer::DensityField density = flat(0.1);
  density.cells.values[3] = 0.02;
  const auto choice = choose_level(saturating(0.04), density, spec, 1000, 1000000);
  EXPECT_NEAR(density.cells.mean() * choice->factor, knee(0.04, 0.27), 0.004);
}

TEST(LevelSearch, DoesNotJumpWithTheNoise) {
  // Noise of 0.4 % of the efficiency at each level. Forty seeds: all within 20 % of the knee, spread below 7 %.
  const double truth = knee(0.04, 0.3);
  double sum = 0.0, squares = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const double log_ratio = std::log(chosen(saturating(0.04, 0.003, 0.0, seed), 0.1) / truth);
    EXPECT_LT(std::abs(log_ratio), 0.2) << seed;
    sum += log_ratio / 40;
    squares += log_ratio * log_ratio / 40;
  }
  EXPECT_LT(std::abs(sum), 0.03);
  EXPECT_LT(std::sqrt(squares - sum * sum), 0.07);
}

TEST(LevelSearch, UsesWhatCommonRandomNumbersShare) {
  // Noise that all levels share moves the curve up and down, hardly its knee: the error that is told must be smaller.
  const auto own = choose_level(saturating(0.04, 0.002, 0.0), flat(0.1), DesignSpec{}, 1000, 1000);
  const auto shared = choose_level(saturating(0.04, 0.002, 0.99), flat(0.1), DesignSpec{}, 1000, 1000);
  EXPECT_GT(own->log_se, 0.01);
  EXPECT_LT(shared->log_se, 0.3 * own->log_se);
}

TEST(LevelSearch, TakesMorePhotonsWhileTheLevelIsUncertain) {
  const auto few = choose_level(saturating(0.04, 0.01), flat(0.1), DesignSpec{}, 1000, 1000);
  const auto more = choose_level(saturating(0.04, 0.01), flat(0.1), DesignSpec{}, 1000, 100000);
  EXPECT_EQ(few->photons, 6000U);
  EXPECT_GT(more->photons, 6000U);
  EXPECT_LT(more->log_se, few->log_se);
}

TEST(LevelSearch, BringsNoFurtherCellToALimit) {
  DesignSpec spec;
  spec.density_max = 0.3;
  EXPECT_NEAR(chosen(saturating(1.0), 0.1, spec), knee(1.0, 0.225), 0.002);  // 3/4 of 0.3
  spec.density_min = 0.09;
  EXPECT_GE(chosen(saturating(0.001), 0.1, spec), 0.09 - 1e-9);
}

TEST(LevelSearch, KeepsALevelThatHasNoRoom) {
  DesignSpec spec;
  spec.density_min = 0.097;
  spec.density_max = 0.13;
  const auto choice = choose_level(saturating(0.04), flat(0.1), spec, 1000, 1000);
  EXPECT_EQ(choice->factor, 1.0);
  EXPECT_EQ(choice->photons, 0U);
  EXPECT_NE(choice->note.find("no room"), std::string::npos);
}

TEST(LevelSearch, FindsTheLevelOfAWantedEfficiency) {
  DesignSpec spec;
  spec.goal.kind = "min_rms";
  spec.goal.efficiency = 0.4;
  EXPECT_NEAR(chosen(saturating(0.1), 0.1, spec), -0.1 * std::log1p(-0.4 / 0.7), 0.001);
}

/// With color: half of the cells have more blue light than the others, by the share `blue(level)`.
ForwardModel colored(double scale, double (*blue)(double)) {
  return
      [=, plain = saturating(scale)](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
        auto o = plain(density, photons, step);
        const core::CellGrid grid = core::CellGrid::over(4, 2, 0, 0, 4, 2);
        o->map = {{grid, 1.0}, {grid, 0.0}};
        o->luminance = o->color_x = o->color_z = core::Tally(8);
        for (int b = 0; b < 20; ++b) {
          std::vector<double> x, y, z;
          for (int i = 0; i < 8; ++i) {
            const double more = i < 4 ? 1.0 + blue(density.cells.mean()) : 1.0;
            const core::Vec3 xyz = more * core::color_matching(460.0) + core::color_matching(570.0);
            x.push_back(xyz.x());
            y.push_back(xyz.y());
            z.push_back(xyz.z());
          }
          o->color_x.add_batch(std::move(x));
          o->luminance.add_batch(std::move(y));
          o->color_z.add_batch(std::move(z));
        }
        return o;
      };
}

TEST(LevelSearch, GoesToALevelWhoseColorKeepsItsBound) {
  // The lower the level, the longer the ways: 10 % more blue light at a level of 0.1, half of it at 0.2.
  const ForwardModel model = colored(0.02, [](double level) { return 0.01 / level; });
  const double knee_level = chosen(model, 0.1);
  EXPECT_LT(knee_level, 0.09);
  DesignSpec spec;
  spec.goal.color = 1.0;
  EXPECT_NEAR(chosen(model, 0.1, spec), knee_level, 1e-9) << "a bound that holds changes nothing";
  spec.goal.color = 0.004;
  const auto choice = choose_level(model, flat(0.1), spec, 1000, 1000000);
  EXPECT_GT(0.1 * choice->factor, 1.1 * knee_level);
  EXPECT_NE(choice->note.find("the nearest that keeps it"), std::string::npos) << choice->note;
  spec.goal.color = 0.0001;
  const auto none = choose_level(model, flat(0.1), spec, 1000, 1000000);
  EXPECT_NEAR(0.1 * none->factor, 0.3, 1e-6);
  EXPECT_NE(none->note.find("no level keeps the bound"), std::string::npos) << none->note;
}

TEST(LevelSearch, IsEmptyWhenInterrupted) {
  const ForwardModel interrupted = [](const tracer::DensityField&, std::uint64_t, std::uint32_t) {
    return std::optional<Observation>();
  };
  EXPECT_FALSE(choose_level(interrupted, flat(0.1), DesignSpec{}, 1000, 1000).has_value());
}

}  // namespace
}  // namespace evenglow::design
