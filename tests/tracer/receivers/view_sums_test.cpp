#include "tracer/receivers/view_sums.h"

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

/// Two directions of three cells, two batches.
core::Tally scores() {
  core::Tally tally(6);
  tally.add_batch({1, 2, 3, 10, 20, 30});
  tally.add_batch({2, 2, 2, 5, 5, 5});
  return tally;
}

TEST(ViewSums, AddTheDirectionsOfACell) {
  const core::Tally sum = sum_of_directions(scores(), 3);
  EXPECT_EQ(sum.bins(), 3U);
  EXPECT_EQ(sum.batch(0), (std::vector<double>{11, 22, 33}));
  EXPECT_EQ(sum.batch(1), (std::vector<double>{7, 7, 7}));
}

TEST(ViewSums, OneDirectionStandsForAll) {
  const core::Tally second = one_direction(scores(), 3, 1, 0.25);
  EXPECT_EQ(second.batch(0), (std::vector<double>{40, 80, 120}));
  EXPECT_EQ(second.batch(1), (std::vector<double>{20, 20, 20}));
}

TEST(ViewSums, OneDirectionAloneIsLeftAsItIs) {
  core::Tally tally(3);
  tally.add_batch({1, 2, 3});
  EXPECT_EQ(sum_of_directions(tally, 3).batch(0), (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace evenglow::tracer
