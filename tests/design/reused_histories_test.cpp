#include "design/updaters/reused_histories.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tracer/transport/arrival_records.h"

/// Histories by hand: what they come to at another density is exact. With traces: path_reuse_updater_test.
namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0);

tracer::DensityField density_of(double left, double right) {
  tracer::DensityField density{core::CellField(kGrid, left)};
  density.cells.values[1] = right;
  return density;
}

/// Three batches of two photons each, traced at `before`. Of each batch the first photon meets the dots of the left
/// cell and leaves light of 1, 2, 3 there, the second passes them and leaves 2 at the right.
RecordedTrace trace_of(const tracer::DensityField& before) {
  std::vector<tracer::ArrivalLog> logs;
  core::Tally luminance(2);
  for (const double light : {1.0, 2.0, 3.0}) {
    tracer::ArrivalLog& log = logs.emplace_back(1000);
    log.arrival(0, true);
    log.deposit(0, light);
    log.end_photon();
    log.arrival(0, false);
    log.deposit(1, 2.0);
    log.end_photon();
    luminance.add_batch({light, 2.0});
  }
  return {std::make_shared<tracer::ArrivalRecords>(before, 2, 1, std::move(logs)), luminance, 6, 0};
}

DesignState state_of(std::vector<RecordedTrace> traces) {
  DesignState state{density_of(0.2, 0.2), {}};
  state.observation.map = {{kGrid, 0.0}, {kGrid, 0.0}};
  state.observation.luminance_unit = 10.0;
  state.recorded = std::move(traces);
  return state;
}

/// (sum W)^2 / (n sum W^2) of the weights met, passed of half the photons each.
double share_of(double met, double passed) {
  return (met + passed) * (met + passed) / (2.0 * (met * met + passed * passed));
}

TEST(WorthOf, IsTheShareOfThePhotonsWhereAllAreRecorded) {
  const RecordedTrace trace = trace_of(density_of(0.2, 0.2));
  EXPECT_NEAR(worth_of(trace, 1.0), 6.0, 1e-12);
  EXPECT_NEAR(worth_of(trace, 0.25), 1.5, 1e-12);
}

/// At the traced density all photons count; far from it, what the records alone are worth.
TEST(WorthOf, ComesFromAllPhotonsToTheRecordedOnes) {
  RecordedTrace trace = trace_of(density_of(0.2, 0.2));
  trace.photons = 4000;
  EXPECT_NEAR(worth_of(trace, 1.0), 4000.0, 1e-9);
  EXPECT_NEAR(worth_of(trace, 0.5), 1.0 / (1.0 / 6.0 + 1.0 / 4000.0), 1e-9);
  EXPECT_NEAR(worth_of(trace, 0.01), 6.0 / 99.0, 1e-4);
  EXPECT_GT(worth_of(trace, 0.0), 0.0);
}

TEST(ReusedHistories, AreNoneWithoutRecords) {
  EXPECT_THROW(ReusedHistories(state_of({}), DesignSpec{}), core::Error);
}

/// Met 0.3/0.2, passed 0.7/0.8: of each batch and of the map, in the unit of the map.
TEST(ReusedHistories, WeighEachHistory) {
  const DesignState state = state_of({trace_of(density_of(0.2, 0.2))});
  const ReusedView view = ReusedHistories(state, DesignSpec{}).at(density_of(0.3, 0.2));
  EXPECT_NEAR(view.effective_share, share_of(1.5, 0.875), 1e-12);
  const Observation& seen = view.state.observation;
  ASSERT_EQ(seen.luminance.batches(), 3U);
  EXPECT_NEAR(seen.luminance.batch(0)[0], 1.5, 1e-12);
  EXPECT_NEAR(seen.luminance.batch(1)[0], 3.0, 1e-12);
  EXPECT_NEAR(seen.luminance.batch(0)[1], 1.75, 1e-12);
  EXPECT_NEAR(seen.map.luminance.values[0], 10.0 * 9.0, 1e-11);
  EXPECT_NEAR(seen.map.luminance.values[1], 10.0 * 5.25, 1e-11);
  EXPECT_NEAR(seen.map.standard_error.values[0], 10.0 * seen.luminance.total(0).se, 1e-11);
  EXPECT_EQ(view.state.density.cells.values, density_of(0.3, 0.2).cells.values);
  // 90 and 52.5 about 71.25.
  EXPECT_NEAR(view.state.record.rms, 18.75 / 71.25, 1e-12);
}

/// Of 12 photons 6 are recorded: L + R(d) - R(d0), each a photon.
TEST(ReusedHistories, AddTheMapOfThePhotonsThatAreNotRecorded) {
  RecordedTrace trace = trace_of(density_of(0.2, 0.2));
  trace.photons = 12;
  trace.luminance = core::Tally(2);
  trace.luminance.add_batch({5.0, 3.0});
  trace.luminance.add_batch({2.0, 6.0});
  trace.luminance.add_batch({4.0, 4.0});
  const DesignState state = state_of({trace});
  const ReusedHistories histories(state, DesignSpec{});
  const ReusedView same = histories.at(density_of(0.2, 0.2));
  EXPECT_NEAR(same.effective_share, 1.0, 1e-12) << "worth all photons";
  EXPECT_NEAR(same.state.observation.luminance.batch(0)[0], 5.0, 1e-12);
  EXPECT_NEAR(same.state.observation.luminance.batch(1)[1], 6.0, 1e-12);
  const ReusedView moved = histories.at(density_of(0.3, 0.2));
  EXPECT_NEAR(moved.state.observation.luminance.batch(0)[0], 5.0 + 2.0 * 0.5, 1e-12);
  EXPECT_NEAR(moved.state.observation.luminance.batch(1)[0], 2.0 + 2.0 * 1.0, 1e-12);
  EXPECT_NEAR(moved.state.observation.luminance.batch(1)[1], 6.0 - 2.0 * 0.25, 1e-12);
  EXPECT_NEAR(moved.effective_share, worth_of(trace, share_of(1.5, 0.875)) / 12.0, 1e-12);
}

/// An older trace counts by what it is worth at the density in question.
TEST(ReusedHistories, AverageTracesByTheirWorth) {
  const RecordedTrace older = trace_of(density_of(0.4, 0.2)), newest = trace_of(density_of(0.2, 0.2));
  const DesignState state = state_of({older, newest});
  const ReusedView view = ReusedHistories(state, DesignSpec{}).at(density_of(0.3, 0.2));
  const double old_share = share_of(0.75, 0.7 / 0.6), new_share = share_of(1.5, 0.875);
  EXPECT_NEAR(view.effective_share, old_share + new_share, 1e-12);
  EXPECT_NEAR(view.state.observation.luminance.batch(0)[0],
              (old_share * 0.75 + new_share * 1.5) / (old_share + new_share), 1e-12);
}

/// Many arrivals make the weights of a trace from afar worthless: it is left out, the newest never is.
TEST(ReusedHistories, LeaveOutWhatIsWorthNothing) {
  std::vector<tracer::ArrivalLog> logs;
  core::Tally luminance(2);
  for (int batch = 0; batch < 3; ++batch) {
    tracer::ArrivalLog& log = logs.emplace_back(100'000);
    for (int photon = 0; photon < 100; ++photon) {
      for (int arrival = 0; arrival < 10; ++arrival) log.arrival(0, photon == 0);
      log.deposit(0, 1.0);
      log.end_photon();
    }
    luminance.add_batch({100.0, 0.0});
  }
  const RecordedTrace far{std::make_shared<tracer::ArrivalRecords>(density_of(0.1, 0.2), 2, 1, std::move(logs)),
                          luminance, 300, 0};
  const tracer::DensityField now = density_of(0.3, 0.2);
  ASSERT_LT(far.records->at(now).effective_share, 0.02);
  const DesignState both = state_of({far, trace_of(density_of(0.2, 0.2))});
  const DesignState one = state_of({trace_of(density_of(0.2, 0.2))});
  const ReusedView with = ReusedHistories(both, DesignSpec{}).at(now);
  const ReusedView without = ReusedHistories(one, DesignSpec{}).at(now);
  EXPECT_EQ(with.effective_share, without.effective_share);
  EXPECT_EQ(with.state.observation.map.luminance.values, without.state.observation.map.luminance.values);
  const DesignState alone = state_of({far});
  EXPECT_GT(ReusedHistories(alone, DesignSpec{}).at(now).effective_share, 0.0);
}

}  // namespace
}  // namespace evenglow::design
