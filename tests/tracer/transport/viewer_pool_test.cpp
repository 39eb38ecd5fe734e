#include "tracer/transport/viewer_pool.h"

#include <set>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace tracer;

void fill(ViewerPool& pool, std::size_t arrivals) {
  pool.refill().clear();
  for (std::size_t i = 0; i < arrivals; ++i) {
    ViewerArrival arrival;
    arrival.display = {static_cast<double>(i), 0.0};
    pool.refill().lists[ViewerArrivals::list(1, true)].push_back(arrival);
  }
  pool.renewed(8);
}

TEST(ViewerPool, IsSpentAfterSoManyScatters) {
  ViewerPool pool(2, core::PhotonRng({1, 0, 0}, 0));
  EXPECT_TRUE(pool.spent(1, 3));  // there is nothing yet
  fill(pool, 5);
  EXPECT_EQ(pool.subpaths(), 8U);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(pool.spent(1, 3));
  EXPECT_TRUE(pool.spent(1, 3));
  fill(pool, 5);
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(pool.spent(4, 3));
  EXPECT_TRUE(pool.spent(4, 3));
}

/// All in turn, from any first one.
TEST(ViewerPool, GivesEachArrivalInTurn) {
  ViewerPool pool(2, core::PhotonRng({1, 0, 0}, 0));
  std::set<double> firsts;
  for (int renewal = 0; renewal < 100; ++renewal) {
    fill(pool, 5);
    const double first = pool.next(ViewerArrivals::list(1, true)).display.x();
    firsts.insert(first);
    for (int i = 1; i < 10; ++i) {
      EXPECT_EQ(pool.next(ViewerArrivals::list(1, true)).display.x(), static_cast<int>(first + i) % 5);
    }
  }
  EXPECT_EQ(firsts.size(), 5U);
}

TEST(ViewerPools, HaveNumbersOfTheirOwn) {
  const auto first = [](const core::RandomKey& key, std::uint64_t photon, std::size_t band) {
    ViewerPools pools;
    pools.seed(key, photon);
    return pools.of_band(band, 1).rng().uniform();
  };
  std::set<double> numbers{core::PhotonRng({1, 0, 0}, 0).uniform(), core::PhotonRng({1, 0, 0}, 5).uniform()};
  for (const double number : {first({1, 0, 0}, 0, 0), first({1, 0, 0}, 5, 0), first({1, 0, 0}, 0, 1),
                              first({1, 1, 0}, 0, 0), first({1, 0, 1}, 0, 0)}) {
    EXPECT_TRUE(numbers.insert(number).second);
  }
  EXPECT_EQ(first({1, 0, 0}, 5, 1), first({1, 0, 0}, 5, 1));
}

}  // namespace
}  // namespace evenglow::tests
