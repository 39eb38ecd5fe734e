#include "design/engine/kept_records.h"

#include <gtest/gtest.h>

#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(2, 1, 0, 0, 2, 1);

/// A model that records nothing but its density.
std::optional<Observation> traced(const tracer::DensityField& density, std::uint64_t photons, std::uint32_t) {
  Observation o;
  o.photons = photons;
  o.luminance = core::Tally(2);
  std::vector<tracer::ArrivalLog> logs;
  logs.emplace_back(1000);
  logs[0].end_photon();
  o.records = std::make_shared<tracer::ArrivalRecords>(density, 2, 1, std::move(logs));
  return o;
}

tracer::DensityField density_of(double a, double b) {
  tracer::DensityField density{core::CellField(kGrid, a)};
  density.cells.values[1] = b;
  return density;
}

TEST(KeptRecords, TracesAgainWhatAnInterruptionLost) {
  UpdaterMemory memory;
  KeptRecords kept;
  kept.keep(density_of(0.1, 0.2), *traced(density_of(0.1, 0.2), 100, 0), 0, memory);
  kept.keep(density_of(0.3, 0.4), *traced(density_of(0.3, 0.4), 400, 1), 1, memory);
  ASSERT_EQ(kept.traces().size(), 2U);
  std::vector<std::uint32_t> steps;
  ForwardModel model = traced;
  model.recording = [&](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
    steps.push_back(step);
    return traced(density, photons, step);
  };
  KeptRecords again;
  EXPECT_TRUE(again.restore(model, density_of(0.9, 0.9), 2, memory));
  EXPECT_EQ(steps, (std::vector<std::uint32_t>{0, 1}));
  ASSERT_EQ(again.traces().size(), 2U);
  EXPECT_EQ(again.traces()[1].photons, 400U);
  EXPECT_EQ(again.traces()[1].density.values, (std::vector<double>{0.3, 0.4}));
  EXPECT_TRUE(again.restore(model, density_of(0.9, 0.9), 2, memory));
  EXPECT_EQ(steps.size(), 2U) << "nothing is traced that is there";
}

TEST(KeptRecords, SaysThatItWasInterrupted) {
  UpdaterMemory memory;
  KeptRecords kept;
  kept.keep(density_of(0.1, 0.2), *traced(density_of(0.1, 0.2), 100, 0), 0, memory);
  ForwardModel model = traced;
  model.recording = [](const auto&, auto, auto) { return std::optional<Observation>(); };
  EXPECT_FALSE(KeptRecords().restore(model, density_of(0.1, 0.1), 1, memory));
}

TEST(KeptRecords, TakesNoTraceWithoutRecords) {
  UpdaterMemory memory;
  KeptRecords kept;
  kept.keep(density_of(0.1, 0.2), Observation{}, 0, memory);
  EXPECT_TRUE(kept.traces().empty());
  EXPECT_TRUE(memory.empty());
}

}  // namespace
}  // namespace evenglow::design
