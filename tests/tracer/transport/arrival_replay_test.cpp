#include "tracer/transport/arrival_replay.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace tracer;

/// Writes down what it is told.
struct Listener {
  std::vector<std::string> told;

  void arrive(std::uint32_t cell, bool met) { told.push_back((met ? "met " : "passed ") + std::to_string(cell)); }
  void cross(std::uint32_t cell) { told.push_back("crossed " + std::to_string(cell)); }
  void share(std::uint32_t cell) { told.push_back("share " + std::to_string(cell)); }
  void deposit(std::uint32_t bin, double amount, bool shared) {
    told.push_back((shared ? "shared " : "deposit ") + std::to_string(bin) + " " + std::to_string(amount));
  }
  void end_photon() { told.emplace_back("end"); }
};

TEST(Replay, TellsWhatTheLogWasTold) {
  ArrivalLog log(1000);
  log.arrival(3, false);
  log.arrival(4, true);
  log.deposit(7, 0.5);
  log.begin_share(5);
  log.deposit(8, 0.25);
  log.end_share();
  log.crossing(6);
  log.deposit(ArrivalLog::kMostIndex, 2.0);
  log.end_photon();
  log.end_photon();
  Listener listener;
  replay(log.take(), listener);
  EXPECT_EQ(listener.told,
            (std::vector<std::string>{"passed 3", "met 4", "deposit 7 0.500000", "share 5", "shared 8 0.250000",
                                      "crossed 6", "deposit 536870911 2.000000", "end", "end"}));
}

TEST(Replay, HasNothingToTellOfNothing) {
  Listener listener;
  replay({}, listener);
  EXPECT_TRUE(listener.told.empty());
}

/// Density 0.2 and 0.5 before, 0.4 and 0.25 now.
TEST(HistoryWeight, IsTheProductOfItsRatios) {
  const core::CellGrid grid = core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0);
  DensityField before{core::CellField(grid, 0.2)}, now{core::CellField(grid, 0.4)};
  before.cells.values[1] = 0.5;
  now.cells.values[1] = 0.25;
  const ArrivalFactors factors(before, now);
  HistoryWeight weight(factors);
  weight.arrive(0, true);   // 0.4/0.2
  weight.arrive(1, false);  // 0.75/0.5
  EXPECT_DOUBLE_EQ(weight.of_arrivals(), 3.0);
  weight.cross(0);  // 0.6/0.8
  EXPECT_DOUBLE_EQ(weight.of_deposit(false), 2.25);
  EXPECT_DOUBLE_EQ(weight.of_deposit(false), 3.0) << "a crossing is of one deposit";
  weight.share(1);  // 0.25/0.5
  EXPECT_DOUBLE_EQ(weight.of_deposit(true), 1.5);
  EXPECT_DOUBLE_EQ(weight.of_deposit(false), 3.0);
  weight.end_photon();
  EXPECT_DOUBLE_EQ(weight.of_deposit(true), 1.0);
}

}  // namespace
}  // namespace evenglow::tests
