#include "design/engine/level_front.h"

#include <set>

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"
#include "design/engine/traced_model.h"
#include "tests/support/coupled_backlight.h"

namespace evenglow::design {
namespace {

struct Case {
  tests::CoupledBacklight backlight;
  ForwardModel model;
  DesignSpec spec;
  DesignLimits limits{100000, 4000000};

  Case() {
    backlight.out = 0.5;
    backlight.noise = 0.005;
    model = backlight;
    spec.stop_rms = 0.01;
    spec.density_min = 0.003;
    spec.density_max = 0.4;
    spec.max_steps = 12;
  }
  FrontJob job() const { return {model, spec, limits, {core::CellField(backlight.grid, 0.05)}}; }
};

TEST(LevelFront, EfficiencyGrowsWithTheLevelUntilALimitSpoilsTheEvenness) {
  const Case c;
  const auto points = design_front(c.job(), {0.02, 0.05, 0.1, 0.36}, {});
  ASSERT_TRUE(points);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((*points)[i].judged.efficiency.value, c.backlight.efficiency((*points)[i].density), 0.005);
    EXPECT_NEAR((*points)[i].judged.rms_corrected.value, c.backlight.true_rms((*points)[i].density),
                5.0 * (*points)[i].judged.rms_corrected.se + 1e-4);
    if (i > 0) {
      EXPECT_GT((*points)[i].judged.efficiency.value, (*points)[i - 1].judged.efficiency.value);
    }
  }
  EXPECT_LT((*points)[1].judged.rms_corrected.value, 0.015);
  EXPECT_GT((*points)[3].judged.rms_corrected.value, 0.03);
  EXPECT_GT((*points)[3].held_high, 0);
}

TEST(LevelFront, NoPointSeesTheRandomNumbersOfAnother) {
  const Case c;
  std::multiset<std::uint32_t> seen;
  const ForwardModel noting = [&](const auto& density, auto photons, auto step) {
    seen.insert(step);
    return c.model(density, photons, step);
  };
  FrontJob job{noting, c.spec, c.limits, {core::CellField(c.backlight.grid, 0.05)}};
  ASSERT_TRUE(design_front(job, {0.03, 0.06, 0.1}, {}));
  EXPECT_EQ(std::set<std::uint32_t>(seen.begin(), seen.end()).size(), seen.size());
}

TEST(LevelFront, GoesOnFromSavedPointsToTheSameBits) {
  const Case c;
  std::map<int, DesignProgress> saved;
  FrontHooks saving;
  saving.stepped = [&](int point, const StepRecord&, const DesignProgress& p) { saved[point] = p; };
  const auto whole = design_front(c.job(), {0.03, 0.06}, saving);
  saved.erase(1);
  FrontHooks loading;
  loading.load = [&](int point) -> std::optional<DesignProgress> {
    const auto found = saved.find(point);
    return found == saved.end() ? std::nullopt : std::optional<DesignProgress>(found->second);
  };
  const auto again = design_front(c.job(), {0.03, 0.06}, loading);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ((*again)[i].density.values, (*whole)[i].density.values);
}

TEST(LevelFront, MostEfficientKeepsItsBound) {
  Case c;
  c.spec.goal.kind = "max_efficiency";
  c.spec.goal.rms = 0.015;
  c.spec.stop_rms = 0.015;
  const auto search = design_most_efficient(c.job(), 0.05, {});
  ASSERT_TRUE(search);
  EXPECT_TRUE(search->feasible);
  const FrontPoint& best = search->points[search->best];
  EXPECT_LT(c.backlight.true_rms(best.density), 0.018);
  EXPECT_GT(best.judged.efficiency.value, search->points.front().judged.efficiency.value);
  // No point that keeps the bound is brighter.
  for (const FrontPoint& point : search->points) {
    if (point.judged.rms_corrected.value > 0.015 + point.judged.rms_corrected.se) continue;
    EXPECT_LE(point.judged.efficiency.value, best.judged.efficiency.value);
  }
}

TEST(LevelFront, MostEfficientGoesDownWhereTheStartBreaksTheBound) {
  Case c;
  c.backlight.out = 2.0;  // a steeper shape: the upper limit binds early
  c.model = c.backlight;
  c.spec.goal.kind = "max_efficiency";
  c.spec.goal.rms = 0.015;
  c.spec.stop_rms = 0.015;
  const auto search = design_most_efficient(c.job(), 0.24, {});
  ASSERT_TRUE(search);
  EXPECT_TRUE(search->feasible);
  EXPECT_LT(search->points[search->best].level, 0.24);
}

/// The color of a backlight whose left half gets more blue light than the right one, by a share that the level decides.
ForwardModel with_color(const ForwardModel& plain, double (*blue)(double)) {
  return [&plain, blue](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
    auto o = plain(density, photons, step);
    if (!o) return o;
    const core::CellGrid& grid = o->map.luminance.grid;
    core::Tally x(grid.size()), y(grid.size()), z(grid.size());
    for (std::size_t b = 0; b < o->luminance.batches(); ++b) {
      std::vector<double> all[3];
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const bool left = static_cast<int>(i) % grid.nx < grid.nx / 2;
        const core::Vec3 xyz =
            (left ? 1.0 + blue(density.cells.mean()) : 1.0) * core::color_matching(460.0) + core::color_matching(570.0);
        for (int k = 0; k < 3; ++k) all[k].push_back(o->luminance.batch(b)[i] * xyz[k] / xyz.y());
      }
      x.add_batch(std::move(all[0]));
      z.add_batch(std::move(all[2]));
    }
    o->color_x = std::move(x);
    o->color_z = std::move(z);
    return o;
  };
}

TEST(LevelFront, MarksThePointsThatBreakTheBoundOfTheColor) {
  Case c;
  const ForwardModel model = with_color(c.model, [](double level) { return 0.01 / level; });
  c.spec.goal.color = 0.006;
  const auto points =
      design_front({model, c.spec, c.limits, {core::CellField(c.backlight.grid, 0.05)}}, {0.03, 0.3}, {});
  ASSERT_TRUE(points);
  EXPECT_GT((*points)[0].color->value, 0.01);
  EXPECT_TRUE((*points)[0].breaks_color);
  EXPECT_LT((*points)[1].color->value, 0.006);
  EXPECT_FALSE((*points)[1].breaks_color);
}

TEST(LevelFront, MostEfficientKeepsTheBoundOfTheColorToEitherSide) {
  Case c;
  c.spec.goal.kind = "max_efficiency";
  c.spec.goal.rms = c.spec.stop_rms = 0.015;
  c.spec.goal.color = 0.006;
  const auto search_of = [&](const ForwardModel& model) {
    return *design_most_efficient({model, c.spec, c.limits, {core::CellField(c.backlight.grid, 0.05)}}, 0.05, {});
  };
  // Evener above: the search has to go up from a start that breaks the bound.
  const EfficiencySearch up = search_of(with_color(c.model, [](double level) { return 0.01 / level; }));
  EXPECT_TRUE(up.feasible);
  EXPECT_FALSE(up.points[up.best].breaks_color);
  EXPECT_GT(up.points[up.best].level, 0.06);
  // Evener below.
  const EfficiencySearch down = search_of(with_color(c.model, [](double level) { return 4.0 * level; }));
  EXPECT_TRUE(down.feasible);
  EXPECT_FALSE(down.points[down.best].breaks_color);
  EXPECT_LT(down.points[down.best].level, 0.05);
  const EfficiencySearch none = search_of(with_color(c.model, [](double) { return 0.5; }));
  EXPECT_FALSE(none.feasible);
}

TEST(LevelFront, PointsOfTheFrontAreNotBeaten) {
  FrontPoint good, dim, uneven, worse;
  good.judged.efficiency = {0.6, 0.001};
  good.judged.rms_corrected = {0.01, 0.001};
  dim = good;
  dim.judged.efficiency.value = 0.5;
  uneven = good;
  uneven.judged.efficiency.value = 0.62;
  uneven.judged.rms_corrected.value = 0.05;
  worse = good;
  worse.judged.efficiency.value = 0.55;
  worse.judged.rms_corrected.value = 0.03;
  EXPECT_EQ(on_front({good, dim, uneven, worse}), (std::vector<bool>{true, false, true, false}));
  // A point that is better only within the errors beats nobody.
  FrontPoint alike = good;
  alike.judged.efficiency.value = 0.601;
  EXPECT_EQ(on_front({good, alike}), (std::vector<bool>{true, true}));
}

TEST(LevelFront, IsEmptyWhenInterrupted) {
  const Case c;
  const ForwardModel interrupted = [](const auto&, auto, auto) { return std::optional<Observation>(); };
  const FrontJob job{interrupted, c.spec, c.limits, {core::CellField(c.backlight.grid, 0.05)}};
  EXPECT_FALSE(design_front(job, {0.05}, {}));
  EXPECT_FALSE(design_most_efficient(job, 0.05, {}));
}

}  // namespace
}  // namespace evenglow::design
