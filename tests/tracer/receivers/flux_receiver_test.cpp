#include "tracer/receivers/flux_receiver.h"

#include <set>

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

TEST(FluxReceiver, EveryEndHasABinOfItsOwn) {
  const FluxReceiver receiver({"plate", "reflector"});
  std::set<std::size_t> bins;
  for (int i = 0; i < kSides; ++i) {
    Crossing crossing;
    crossing.side = static_cast<Side>(i);
    crossing.estimated = i % 2 == 0;  // the energy account counts photons, estimated or not
    const auto score = receiver.score(crossing);
    ASSERT_TRUE(score);
    EXPECT_EQ(score->bin, static_cast<std::size_t>(i));
    EXPECT_EQ(score->weight, 1.0);
    bins.insert(score->bin);
  }
  for (int part = 0; part < 2; ++part) bins.insert(receiver.absorbed_bin(part));
  for (int reason = 0; reason < kLossReasons; ++reason) bins.insert(receiver.lost_bin(static_cast<LossReason>(reason)));
  EXPECT_EQ(bins.size(), receiver.bins());
  EXPECT_EQ(*bins.rbegin(), receiver.bins() - 1);
}

}  // namespace
}  // namespace evenglow::tracer
