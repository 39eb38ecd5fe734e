#include "tracer/polarized_bsdf/alias_tables.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

TEST(AliasTables, GivesEachOutcomeItsShare) {
  AliasTables tables(5);
  tables.add(std::vector<double>{1, 1, 1, 1, 1});
  tables.add(std::vector<double>{0, 5, 1, 0, 2});
  std::vector<double> counts(5, 0.0);
  constexpr int kSteps = 800000;  // an even comb, so no statistics
  for (int i = 0; i < kSteps; ++i) counts[tables.draw(1, (i + 0.5) / kSteps)] += 1.0 / kSteps;
  const std::vector<double> expected{0.0, 0.625, 0.125, 0.0, 0.25};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(counts[i], expected[i], 5e-6) << i;
}

TEST(AliasTables, AllZeroIsUniform) {
  AliasTables tables(4);
  tables.add(std::vector<double>(4, 0.0));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(tables.draw(0, (static_cast<double>(i) + 0.5) / 4.0), i);
}

TEST(AliasTables, RefusesWrongSizes) {
  EXPECT_THROW(AliasTables(0), core::Error);
  EXPECT_THROW(AliasTables(4097), core::Error);
  AliasTables tables(3);
  EXPECT_THROW(tables.add(std::vector<double>{1, 2}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
