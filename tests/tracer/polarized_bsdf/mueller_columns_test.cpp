#include "tracer/polarized_bsdf/mueller_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/light/mueller.h"
#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

std::vector<double> row_of(const core::MuellerMatrix& M) {
  std::vector<double> row(mueller_columns().size());
  for (std::size_t e = 0; e < 16; ++e) row[kFirstEntry + e] = M(static_cast<int>(e / 4), static_cast<int>(e % 4));
  return row;
}

TEST(MuellerColumns, BeginAsATableOfTauDoes) {
  for (std::size_t c = 0; c <= kLambda; ++c) {
    EXPECT_EQ(mueller_columns()[c].name, bsdf_columns()[c].name);
    EXPECT_EQ(mueller_columns()[c].max, bsdf_columns()[c].max);
  }
  EXPECT_EQ(mueller_columns()[kFirstEntry].name, "m00");
  EXPECT_EQ(mueller_columns()[kFirstEntry + 15].name, "m33");
  EXPECT_TRUE(mueller_columns()[kFirstEntry + 15].required);
  EXPECT_FALSE(mueller_columns()[kFirstEntry + 16].required);
}

TEST(MuellerColumns, AMatrixMustBePhysical) {
  EXPECT_FALSE(mueller_row_fault(row_of(core::diattenuator(0.7, 0.1))));
  EXPECT_FALSE(mueller_row_fault(row_of(core::MuellerMatrix::Zero())));
  core::MuellerMatrix gain = core::MuellerMatrix::Identity();
  gain(1, 1) = 1.1;
  ASSERT_TRUE(mueller_row_fault(row_of(gain)));
  EXPECT_EQ(mueller_row_fault(row_of(gain))->first, kFirstEntry);
  EXPECT_THAT(mueller_row_fault(row_of(gain))->second, testing::HasSubstr("must be physical"));
  core::MuellerMatrix negative = -core::MuellerMatrix::Identity();
  EXPECT_THAT(mueller_row_fault(row_of(negative))->second, testing::HasSubstr("must be above 0"));
}

TEST(MuellerColumns, TwelveDigitsAreEnough) {
  core::MuellerMatrix M = core::rotator(0.3) * core::diattenuator(0.7, 0.0) * core::rotator(0.9);
  for (int e = 0; e < 16; ++e) M(e / 4, e % 4) = std::round(M(e / 4, e % 4) * 1e11) * 1e-11;
  EXPECT_FALSE(mueller_row_fault(row_of(M)));
}

}  // namespace
}  // namespace evenglow::tracer
