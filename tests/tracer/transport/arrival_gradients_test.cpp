#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/recorded_backlights.h"
#include "tests/support/scenes.h"
#include "tracer/transport/arrival_records.h"
#include "tracer/transport/tracer.h"

/// Derivatives in many directions at once against those in one: the same records on both sides, so there is no noise.
namespace evenglow::tests {
namespace {

using namespace tracer;

class GradientsOf : public ::testing::TestWithParam<std::string> {
 protected:
  GradientsOf() : scene_(scene_of(GetParam())), there_(initial_density(scene_.spec)) {
    TraceOptions options;
    options.photons = 5'000;
    options.batches = 50;
    options.key = {8, 0, 0};
    options.threads = 2;
    options.record_bytes = std::size_t{64} << 20;
    records_ = trace(scene_, there_, options)->records;
    for (std::size_t i = 0; i < there_.cells.values.size(); ++i)
      there_.cells.values[i] *= 1.0 + 0.2 * std::sin(static_cast<double>(i));
  }

  /// 1 at each third cell.
  core::CellField direction(std::size_t first) const {
    core::CellField field(there_.cells.grid, 0.0);
    for (std::size_t i = first; i < field.values.size(); i += 3) field.values[i] = 1.0;
    return field;
  }

  Scene scene_;
  DensityField there_;
  std::shared_ptr<const ArrivalRecords> records_;
};

TEST_P(GradientsOf, AWeightedSumAreItsDerivatives) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < scene_.luminance.bins(); ++i) weights.push_back(std::cos(0.7 * static_cast<double>(i)));
  const core::CellField gradient = records_->gradient(there_, weights);
  for (std::size_t k = 0; k < 3; ++k) {
    const core::CellField along = direction(k);
    double found = 0.0;
    for (std::size_t i = 0; i < along.values.size(); ++i) found += along.values[i] * gradient.values[i];
    const double expected = records_->derivative(there_, along).weighted_total(weights).value;
    ASSERT_GT(std::abs(expected), 1e-3);
    EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected));
  }
}

TEST_P(GradientsOf, RowsAreTheirDerivativesWithTheirErrors) {
  DirectionSet directions{3, std::vector<std::array<DirectionSet::Part, 4>>(there_.cells.values.size())};
  for (std::size_t i = 0; i < directions.of_cell.size(); ++i)
    directions.of_cell[i][0] = {static_cast<std::uint32_t>(i % 3), 1.0F};
  std::vector<std::uint32_t> row_of_bin;
  for (std::size_t i = 0; i < scene_.luminance.bins(); ++i) row_of_bin.push_back(i < 10 ? 0 : 1);
  const RecordedSlopes slopes = records_->jacobian(there_, directions, row_of_bin, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const core::Tally derivative = records_->derivative(there_, direction(k));
    for (std::size_t row = 0; row < 2; ++row) {
      std::vector<double> ones(derivative.bins(), 0.0);
      for (std::size_t i = 0; i < ones.size(); ++i) ones[i] = row_of_bin[i] == row ? 1.0 : 0.0;
      const core::Estimate expected = derivative.weighted_total(ones);
      const auto r = static_cast<Eigen::Index>(row), c = static_cast<Eigen::Index>(k);
      EXPECT_NEAR(slopes.mean(r, c), expected.value, 1e-3 * expected.se);  // sums of floats
      EXPECT_NEAR(std::sqrt(slopes.variance(r, c)), expected.se, 1e-3 * expected.se);
    }
  }
}

TEST_P(GradientsOf, RefuseWhatDoesNotFit) {
  EXPECT_THROW(records_->gradient(there_, {1.0}), core::Error);
  EXPECT_THROW(records_->jacobian(there_, {}, std::vector<std::uint32_t>(scene_.luminance.bins(), 0), 1), core::Error);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GradientsOf, ::testing::Values(kRecordedDots, kRecordedLenses));

/// By hand: met in cell 0, a deposit in proportion to cell 1, passed there, one through the face at cell 0. The events
/// are those of ArrivalRecords.WeighEachOutcome.
TEST(ArrivalGradients, OfOneHistory) {
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
  DensityField density{core::CellField(core::CellGrid::over(2, 1, 0.0, 0.0, 2.0, 1.0), 0.0)};
  density.cells.values = {0.2, 0.5};
  std::vector<ArrivalLog> logs;
  logs.push_back(std::move(log));
  const ArrivalRecords records(density, 2, 1, std::move(logs));
  const core::CellField gradient = records.gradient(density, {10.0, 1.0});
  EXPECT_NEAR(gradient.values[0], 10.0 + 2.0 + 4.0 - 0.25 * 2.0, 1e-12);
  EXPECT_NEAR(gradient.values[1], 10.0 - 1.0 * (2.0 + 4.0), 1e-12);
}

}  // namespace
}  // namespace evenglow::tests
