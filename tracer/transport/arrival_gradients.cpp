#include <algorithm>
#include <ranges>
#include <utility>

#include "core/base/error.h"
#include "tracer/transport/arrival_factors.h"
#include "tracer/transport/arrival_records.h"
#include "tracer/transport/arrival_replay.h"

/// Derivatives of recorded luminance in many directions at once.
namespace evenglow::tracer {
namespace {

/// Sums of one batch: dS/d ln density of each cell. A history is replayed to its end, then run through backwards, where
/// each event takes what came after it.
class BatchGradient {
 public:
  /// `weights`: of each bin in S.
  BatchGradient(const ArrivalFactors& factors, const std::vector<double>& weights)
      : factors_(factors), weights_(weights), weight_(factors), sums_(factors.met.size()) {}

  void arrive(std::uint32_t cell, bool met) {
    weight_.arrive(cell, met);
    events_.push_back({met ? LogKind::kMet : LogKind::kPassed, cell, 0.0});
  }
  void cross(std::uint32_t cell) {
    weight_.cross(cell);
    events_.push_back({LogKind::kCrossed, cell, 0.0});
  }
  void share(std::uint32_t cell) {
    weight_.share(cell);
    events_.push_back({LogKind::kShare, cell, 0.0});
  }
  void deposit(std::uint32_t bin, double amount, bool shared) {
    const double value = weights_[bin] * weight_.of_deposit(shared) * amount;
    events_.push_back({shared ? LogKind::kShared : LogKind::kDeposit, bin, value});
  }
  void end_photon() {
    add_backwards();
    events_.clear();
    weight_.end_photon();
  }
  std::vector<double> take() { return std::move(sums_); }

 private:
  struct Event {
    LogKind kind;
    std::uint32_t index;
    double value;  ///< what a deposit adds to S
  };

  void add_backwards() {
    double later = 0.0, shared = 0.0, next = 0.0;
    for (const auto& event : std::views::reverse(events_)) {
      switch (event.kind) {
        case LogKind::kPassed:
          sums_[event.index] += factors_.slope_passed[event.index] * later;
          break;
        case LogKind::kMet:
          sums_[event.index] += later;
          break;
        case LogKind::kCrossed:
          sums_[event.index] += factors_.slope_passed[event.index] * next;
          break;
        case LogKind::kShare:
          sums_[event.index] += shared;
          shared = 0.0;
          break;
        case LogKind::kShared:
          shared += event.value;
          [[fallthrough]];
        case LogKind::kDeposit:
          later += event.value;
          next = event.value;
          break;
        case LogKind::kPhotonEnd:
          break;
      }
    }
  }

  const ArrivalFactors& factors_;
  const std::vector<double>& weights_;
  HistoryWeight weight_;
  std::vector<double> sums_;
  std::vector<Event> events_;
};

using Scores = Eigen::Array<float, Eigen::Dynamic, 1>;

/// Sums of one batch: a row of slopes for each row of bins.
class BatchJacobian {
 public:
  BatchJacobian(const ArrivalFactors& factors, const DirectionSet& directions,
                const std::vector<std::uint32_t>& row_of_bin, std::size_t rows)
      : factors_(factors),
        directions_(directions),
        row_of_bin_(row_of_bin),
        weight_(factors),
        scores_(Scores::Zero(static_cast<Eigen::Index>(directions.count))),
        sums_(Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(directions.count), static_cast<Eigen::Index>(rows))) {}

  void arrive(std::uint32_t cell, bool met) {
    weight_.arrive(cell, met);
    add(cell, met ? 1.0 : factors_.slope_passed[cell], scores_);
  }
  void cross(std::uint32_t cell) {
    weight_.cross(cell);
    crossings_.push_back(cell);
  }
  void share(std::uint32_t cell) {
    weight_.share(cell);
    share_cell_ = cell;
  }
  void deposit(std::uint32_t bin, double amount, bool shared) {
    const double value = weight_.of_deposit(shared) * amount;
    auto sums = sums_.col(static_cast<Eigen::Index>(row_of_bin_[bin])).array();
    sums += static_cast<float>(value) * scores_;
    if (shared) add(share_cell_, value, sums);
    for (const std::uint32_t cell : crossings_) add(cell, value * factors_.slope_passed[cell], sums);
    crossings_.clear();
  }
  void end_photon() {
    weight_.end_photon();
    scores_.setZero();
    crossings_.clear();
  }
  /// Directions x rows.
  Eigen::MatrixXf take() { return std::move(sums_); }

 private:
  template <typename Array>
  void add(std::uint32_t cell, double value, Array& into) const {
    for (const DirectionSet::Part& part : directions_.of_cell[cell])
      into[static_cast<Eigen::Index>(part.direction)] += part.weight * static_cast<float>(value);
  }

  const ArrivalFactors& factors_;
  const DirectionSet& directions_;
  const std::vector<std::uint32_t>& row_of_bin_;
  HistoryWeight weight_;
  Scores scores_;
  Eigen::MatrixXf sums_;  // directions x rows: a deposit writes to one column
  std::uint32_t share_cell_ = 0;
  std::vector<std::uint32_t> crossings_;
};

}  // namespace

core::CellField ArrivalRecords::gradient(const DensityField& density, const std::vector<double>& weights) const {
  core::expects(weights.size() == bins_, "a weight for each cell of the display");
  const ArrivalFactors factors(density_, density);
  const auto sums = of_batches([&](std::size_t batch) {
    BatchGradient own(factors, weights);
    replay(words_[batch], own);
    return own.take();
  });
  core::CellField result(density_.cells.grid, 0.0);
  for (std::size_t batch = 0; batch < sums.size(); ++batch) {
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += batch_scale(batch) * sums[batch][i];
  }
  return result;
}

RecordedSlopes ArrivalRecords::jacobian(const DensityField& density, const DirectionSet& directions,
                                        const std::vector<std::uint32_t>& row_of_bin, std::size_t rows) const {
  core::expects(directions.of_cell.size() == density_.cells.values.size(), "parts for each cell of the density");
  core::expects(row_of_bin.size() == bins_, "a row for each cell of the display");
  const ArrivalFactors factors(density_, density);
  const auto sums = of_batches([&](std::size_t batch) {
    BatchJacobian own(factors, directions, row_of_bin, rows);
    replay(words_[batch], own);
    const Eigen::MatrixXf slopes = own.take();
    return std::vector<double>(slopes.data(), slopes.data() + slopes.size());
  });
  const auto count = static_cast<double>(sums.size());
  const auto columns = static_cast<Eigen::Index>(directions.count);
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), columns), squares = mean;
  for (std::size_t batch = 0; batch < sums.size(); ++batch) {
    const Eigen::Map<const Eigen::MatrixXd> slopes(sums[batch].data(), columns, static_cast<Eigen::Index>(rows));
    const Eigen::MatrixXd own = batch_scale(batch) * slopes.transpose();
    mean += own;
    squares += own.cwiseAbs2();
  }
  // Of a sum of n batches: n times the variance of one.
  const Eigen::MatrixXd variance = (squares - mean.cwiseAbs2() / count) * (count / std::max(1.0, count - 1.0));
  return {std::move(mean), variance.cwiseMax(0.0)};
}

}  // namespace evenglow::tracer
