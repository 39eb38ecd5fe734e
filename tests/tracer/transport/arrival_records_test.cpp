#include "tracer/transport/arrival_records.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"
#include "tests/support/recorded_backlights.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Records of histories, re-weighted, against closed forms and against fresh traces of the polarized scene.
namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kCounted =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [8, 4], density: "
    "0.2, "
    "kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: {}}, "
    "receivers: [{kind: luminance, cells: [8, 4], cone_deg: 60, estimator: counting}]";

DensityField graded(const Scene& scene, double left, double right) {
  DensityField density = initial_density(scene.spec);
  const core::CellGrid& grid = density.cells.grid;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      density.cells.values[static_cast<std::size_t>(iy * grid.nx + ix)] =
          left + (right - left) * ix / (grid.nx - 1) + 0.01 * (iy % 2);
    }
  }
  return density;
}

TraceResult traced(const Scene& scene, const DensityField& density, std::uint64_t photons, std::uint64_t seed,
                   std::size_t record_bytes, TracePath path = TracePath::kPlanar) {
  TraceOptions options;
  options.photons = photons;
  options.batches = 50;
  options.key = {seed, 0, 0};
  options.threads = 2;
  options.path = path;
  options.record_bytes = record_bytes;
  return *trace(scene, density, options);
}

constexpr std::size_t kEnough = std::size_t{256} << 20;

TEST(ArrivalRecords, AreTheTraceItselfAtItsOwnDensity) {
  for (const auto& yaml : {kRecordedDots, kCounted, kRecordedLenses}) {
    const Scene scene = scene_of(yaml);
    const DensityField density = graded(scene, 0.1, 0.3);
    const TraceResult plain = traced(scene, density, 20'000, 1, 0);
    const TraceResult kept = traced(scene, density, 20'000, 1, kEnough);
    ASSERT_TRUE(kept.records);
    EXPECT_FALSE(plain.records);
    const Reweighted same = kept.records->at(density);
    EXPECT_EQ(same.photons, 20'000U);
    EXPECT_DOUBLE_EQ(same.effective_share, 1.0);
    for (std::size_t batch = 0; batch < 50; ++batch) {
      EXPECT_EQ(plain.luminance.batch(batch), kept.luminance.batch(batch));
      for (std::size_t bin = 0; bin < plain.luminance.bins(); ++bin) {
        const double value = plain.luminance.batch(batch)[bin];
        EXPECT_NEAR(same.luminance.batch(batch)[bin], value, 1e-6 * value);  // amounts are floats
      }
    }
  }
}

/// The mean over all cells and each cell. False alarms: 0.003 for the mean, 0.001 for the chi-square, each scene.
void expect_equal(const core::Tally& a, const core::Tally& b) {
  const std::vector<double> ones(a.bins(), 1.0);
  const core::Estimate x = a.weighted_total(ones), y = b.weighted_total(ones);
  EXPECT_LT(std::abs(x.value - y.value), 3.0 * std::hypot(x.se, y.se)) << x.value << " +- " << x.se << ", " << y.value;
  double statistic = 0.0;
  for (std::size_t i = 0; i < a.bins(); ++i) {
    const core::Estimate p = a.total(i), q = b.total(i);
    statistic += std::pow(p.value - q.value, 2) / (p.se * p.se + q.se * q.se);
  }
  EXPECT_GT(chi_square_tail(statistic, static_cast<double>(a.bins())), 0.001) << statistic << " of " << a.bins();
}

class ReweightedTo : public ::testing::TestWithParam<std::string> {};

TEST_P(ReweightedTo, IsAFreshTraceThere) {
  const Scene scene = scene_of(GetParam());
  constexpr std::uint64_t kPhotons = 200'000;
  const DensityField before = graded(scene, 0.1, 0.3), now = graded(scene, 0.13, 0.25);
  const TraceResult kept = traced(scene, before, kPhotons, 2, kEnough);
  ASSERT_TRUE(kept.records);
  const Reweighted moved = kept.records->at(now);
  const TraceResult fresh = traced(scene, now, kPhotons, 3, 0);
  EXPECT_GT(moved.effective_share, 0.25);
  expect_equal(moved.luminance, fresh.luminance);
}

TEST_P(ReweightedTo, IsAFreshTraceThereByTheGeneralPath) {
  const Scene scene = scene_of(GetParam());
  constexpr std::uint64_t kPhotons = 50'000;
  const DensityField before = graded(scene, 0.1, 0.3), now = graded(scene, 0.13, 0.25);
  const TraceResult kept = traced(scene, before, kPhotons, 2, kEnough, TracePath::kGeneral);
  ASSERT_TRUE(kept.records);
  const TraceResult fresh = traced(scene, now, kPhotons, 3, 0);
  expect_equal(kept.records->at(now).luminance, fresh.luminance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReweightedTo, ::testing::Values(kRecordedDots, kCounted, kRecordedLenses));

/// The mean over the display against central differences of traces with common random numbers, +-10 % of a block. Eight
/// blocks, each within 3 sigma (false alarm 0.02 in all); the third order is far below the noise.
TEST(ArrivalRecords, DerivativeIsThatOfTraces) {
  const Scene scene = scene_of(kRecordedDots);
  constexpr std::uint64_t kPhotons = 200'000;
  const DensityField density = graded(scene, 0.1, 0.3);
  const TraceResult kept = traced(scene, density, kPhotons, 4, kEnough);
  ASSERT_TRUE(kept.records);
  const core::CellGrid& grid = density.cells.grid;
  const double step = 0.1;
  for (int block = 0; block < 8; ++block) {
    core::CellField direction(grid, 0.0);
    std::vector<double> here(scene.luminance.bins(), 0.0);
    for (int iy = 0; iy < grid.ny; ++iy) {
      for (int ix = 0; ix < grid.nx; ++ix) {
        if (ix / 2 + 4 * (iy / 2) != block) continue;
        direction.values[static_cast<std::size_t>(iy * grid.nx + ix)] = 1.0;
        here[static_cast<std::size_t>(iy * grid.nx + ix)] = 1.0;
      }
    }
    DensityField more = density, less = density;
    for (std::size_t i = 0; i < direction.values.size(); ++i) {
      more.cells.values[i] *= std::exp(step * direction.values[i]);
      less.cells.values[i] *= std::exp(-step * direction.values[i]);
    }
    const core::Tally up = traced(scene, more, kPhotons, 5, 0).luminance;
    const core::Tally down = traced(scene, less, kPhotons, 5, 0).luminance;
    core::Tally difference(up.bins());
    for (std::size_t b = 0; b < up.batches(); ++b) {
      std::vector<double> slope(up.bins());
      for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (up.batch(b)[i] - down.batch(b)[i]) / (2.0 * step);
      difference.add_batch(std::move(slope));
    }
    const core::Estimate expected = difference.weighted_total(here);
    const core::Estimate found = kept.records->derivative(density, direction).weighted_total(here);
    EXPECT_LT(std::abs(found.value - expected.value), 3.0 * std::hypot(found.se, expected.se))
        << block << ": " << found.value << " +- " << found.se << ", " << expected.value << " +- " << expected.se;
    EXPECT_GT(std::abs(expected.value), 5.0 * expected.se) << "the test could not fail";
  }
}

/// No noise: the same records on both sides.
TEST(ArrivalRecords, DerivativeIsThatOfTheirOwnLuminance) {
  for (const auto& yaml : {kRecordedDots, kRecordedLenses}) {
    const Scene scene = scene_of(yaml);
    const DensityField density = graded(scene, 0.1, 0.3), other = graded(scene, 0.12, 0.28);
    const TraceResult kept = traced(scene, density, 5'000, 6, kEnough);
    ASSERT_TRUE(kept.records);
    core::CellField direction(density.cells.grid, 0.0);
    for (std::size_t i = 0; i < direction.values.size(); ++i) direction.values[i] = std::sin(static_cast<double>(i));
    const double step = 1e-5;
    DensityField more = other, less = other;
    for (std::size_t i = 0; i < direction.values.size(); ++i) {
      more.cells.values[i] *= std::exp(step * direction.values[i]);
      less.cells.values[i] *= std::exp(-step * direction.values[i]);
    }
    const core::Tally up = kept.records->at(more).luminance, down = kept.records->at(less).luminance;
    const core::Tally slope = kept.records->derivative(other, direction);
    double largest = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < slope.bins(); ++i) {
      const double expected = (up.total(i).value - down.total(i).value) / (2.0 * step);
      largest = std::max(largest, std::abs(expected));
      worst = std::max(worst, std::abs(slope.total(i).value - expected));
    }
    EXPECT_LT(worst, 1e-5 * largest);
    EXPECT_GT(largest, 0.0);
  }
}

TEST(ArrivalRecords, KeepToTheirMemory) {
  const Scene scene = scene_of(kRecordedDots);
  const DensityField density = graded(scene, 0.1, 0.3);
  const TraceResult kept = traced(scene, density, 50'000, 7, 1'000'000);
  ASSERT_TRUE(kept.records);
  EXPECT_LT(kept.records->photons(), 50'000U);
  EXPECT_GT(kept.records->bytes(), 900'000U);
  EXPECT_LT(kept.records->bytes(), 1'200'000U);  // the last photon of each of 50 batches is whole
  const Reweighted same = kept.records->at(density);
  const std::vector<double> ones(same.luminance.bins(), 1.0);
  const core::Estimate part = same.luminance.weighted_total(ones), all = kept.luminance.weighted_total(ones);
  const double ratio = 50'000.0 / static_cast<double>(kept.records->photons());
  EXPECT_LT(std::abs(part.value * ratio - all.value), 4.0 * part.se * ratio);
}

TEST(ArrivalRecords, RefuseOtherCells) {
  const ArrivalRecords records({core::CellField(core::CellGrid{}, 0.1)}, 1, 1, std::vector<ArrivalLog>(1));
  EXPECT_THROW(records.at({core::CellField(core::CellGrid::over(2, 1, 0, 0, 1, 1), 0.1)}), core::Error);
}

/// One history by hand: met in cell 0, a deposit in proportion to cell 1, passed there, one through the face at cell 0.
TEST(ArrivalRecords, WeighEachOutcome) {
  ArrivalLog log(1000);
  log.arrival(0, true);
  log.begin_share(1);
  log.deposit(0, 1.0);
  log.end_share();
  log.arrival(1, false);
  log.crossing(0);
  log.deposit(1, 2.0);
  log.deposit(1, 4.0);
  log.end_photon();
  const core::CellGrid grid = core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0);
  DensityField before{core::CellField(grid, 0.2)}, now{core::CellField(grid, 0.0)};
  now.cells.values = {0.3, 0.5};
  std::vector<ArrivalLog> logs;
  logs.push_back(std::move(log));
  const ArrivalRecords records(before, 2, 1, std::move(logs));
  const Reweighted moved = records.at(now);
  EXPECT_NEAR(moved.luminance.batch(0)[0], 1.5 * 2.5, 1e-12);
  EXPECT_NEAR(moved.luminance.batch(0)[1], 1.5 * (0.5 / 0.8) * (2.0 * 0.7 / 0.8 + 4.0), 1e-12);
  EXPECT_DOUBLE_EQ(moved.effective_share, 1.0);
}

}  // namespace
}  // namespace evenglow::tests
