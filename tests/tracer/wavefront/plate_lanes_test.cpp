#include "tracer/wavefront/plate_lanes.h"

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using namespace tracer;

/// The numbers of a group, one after the other as in memory.
using Words = std::array<std::uint32_t, sizeof(PlateLanes) / sizeof(std::uint32_t)>;

TEST(PlateLanes, CopiesEveryNumberOfALaneAndNoOther) {
  Words source{};
  std::iota(source.begin(), source.end(), 1000);
  const auto from = std::bit_cast<PlateLanes>(source);
  auto to = std::bit_cast<PlateLanes>(Words{});
  copy_lane(from, 3, to, 5);
  const auto target = std::bit_cast<Words>(to);
  for (std::size_t i = 0; i < target.size(); ++i) {
    EXPECT_EQ(target[i], i % kLanes == 5 ? source[i - 2] : 0u) << i;
  }
}

}  // namespace
}  // namespace evenglow::tests
