#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/error.h"
#include "tracer/transport/arrival_factors.h"
#include "tracer/transport/arrival_records.h"

/// Derivatives of recorded luminance in many directions at once.
namespace evenglow::tracer {
namespace {

constexpr std::uint32_t kIndexMask = ArrivalLog::kMostIndex;

LogKind kind_of(std::uint32_t word) {
  return static_cast<LogKind>(word >> ArrivalLog::kKindShift);
}

/// A word of a history with what its deposit adds to the sum.
struct Event {
  std::uint32_t word;
  double value;
};

/// Forward through a history: the value of each deposit. Returns the word after its end.
const std::uint32_t* values_of(const std::uint32_t* at, const ArrivalFactors& factors,
                               const std::vector<double>& weights, std::vector<Event>& events) {
  double weight = 1.0, crossed = 1.0, share = 1.0;
  events.clear();
  for (;; ++at) {
    const std::uint32_t index = *at & kIndexMask;
    Event event{*at, 0.0};
    switch (kind_of(*at)) {
      case LogKind::kPassed:
        weight *= factors.passed[index];
        break;
      case LogKind::kMet:
        weight *= factors.met[index];
        break;
      case LogKind::kCrossed:
        crossed *= factors.passed[index];
        break;
      case LogKind::kShare:
        share = factors.met[index];
        break;
      case LogKind::kDeposit:
      case LogKind::kShared:
        event.value = weights[index] * weight * crossed * static_cast<double>(std::bit_cast<float>(*++at));
        if (kind_of(event.word) == LogKind::kShared) event.value *= share;
        crossed = 1.0;
        break;
      case LogKind::kPhotonEnd:
        return at + 1;
    }
    events.push_back(event);
  }
}

/// Backwards: each event takes what came after it.
void add_backwards(const std::vector<Event>& events, const ArrivalFactors& factors, std::vector<double>& gradient) {
  double later = 0.0, shared = 0.0, next = 0.0;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    const std::uint32_t index = event->word & kIndexMask;
    switch (kind_of(event->word)) {
      case LogKind::kPassed:
        gradient[index] += factors.slope_passed[index] * later;
        break;
      case LogKind::kMet:
        gradient[index] += later;
        break;
      case LogKind::kCrossed:
        gradient[index] += factors.slope_passed[index] * next;
        break;
      case LogKind::kShare:
        gradient[index] += shared;
        shared = 0.0;
        break;
      case LogKind::kShared:
        shared += event->value;
        [[fallthrough]];
      case LogKind::kDeposit:
        later += event->value;
        next = event->value;
        break;
      case LogKind::kPhotonEnd:
        break;
    }
  }
}

using Scores = Eigen::Array<float, Eigen::Dynamic, 1>;

/// Sums of one batch: a row of slopes for each row of bins.
class BatchJacobian {
 public:
  BatchJacobian(const ArrivalFactors& factors, const DirectionSet& directions, std::size_t rows)
      : factors_(factors),
        directions_(directions),
        scores_(Scores::Zero(static_cast<Eigen::Index>(directions.count))),
        sums_(Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(directions.count), static_cast<Eigen::Index>(rows))) {}

  void begin() {
    scores_.setZero();
    weight_ = crossed_ = share_ = 1.0;
    crossings_.clear();
  }
  void arrive(std::uint32_t cell, bool met) {
    weight_ *= met ? factors_.met[cell] : factors_.passed[cell];
    add(cell, met ? 1.0 : factors_.slope_passed[cell], scores_);
  }
  void cross(std::uint32_t cell) {
    crossed_ *= factors_.passed[cell];
    crossings_.push_back(cell);
  }
  void share(std::uint32_t cell) {
    share_ = factors_.met[cell];
    share_cell_ = cell;
  }
  void deposit(std::uint32_t row, double amount, bool shared) {
    const double value = weight_ * crossed_ * amount * (shared ? share_ : 1.0);
    auto sums = sums_.col(static_cast<Eigen::Index>(row)).array();
    sums += static_cast<float>(value) * scores_;
    if (shared) add(share_cell_, value, sums);
    for (const std::uint32_t cell : crossings_) add(cell, value * factors_.slope_passed[cell], sums);
    crossings_.clear();
    crossed_ = 1.0;
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
  Scores scores_;
  Eigen::MatrixXf sums_;  // directions x rows: a deposit writes to one column
  double weight_ = 1.0, crossed_ = 1.0, share_ = 1.0;
  std::uint32_t share_cell_ = 0;
  std::vector<std::uint32_t> crossings_;
};

void add_batch(const std::vector<std::uint32_t>& words, const std::vector<std::uint32_t>& row_of_bin,
               BatchJacobian& sums) {
  sums.begin();
  const std::uint32_t* const end = words.data() + words.size();
  for (const std::uint32_t* at = words.data(); at != end; ++at) {
    const std::uint32_t index = *at & kIndexMask;
    const LogKind kind = kind_of(*at);
    switch (kind) {
      case LogKind::kPassed:
      case LogKind::kMet:
        sums.arrive(index, kind == LogKind::kMet);
        break;
      case LogKind::kCrossed:
        sums.cross(index);
        break;
      case LogKind::kShare:
        sums.share(index);
        break;
      case LogKind::kDeposit:
      case LogKind::kShared:
        sums.deposit(row_of_bin[index], static_cast<double>(std::bit_cast<float>(*++at)), kind == LogKind::kShared);
        break;
      case LogKind::kPhotonEnd:
        sums.begin();
        break;
    }
  }
}

}  // namespace

core::CellField ArrivalRecords::gradient(const DensityField& density, const std::vector<double>& weights) const {
  core::expects(weights.size() == bins_, "a weight for each cell of the display");
  const ArrivalFactors factors(density_, density);
  const auto sums = of_batches([&](std::size_t batch) {
    std::vector<double> own(density_.cells.values.size(), 0.0);
    std::vector<Event> events;
    const std::uint32_t* const end = words_[batch].data() + words_[batch].size();
    for (const std::uint32_t* at = words_[batch].data(); at != end;) {
      at = values_of(at, factors, weights, events);
      add_backwards(events, factors, own);
    }
    return own;
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
    BatchJacobian own(factors, directions, rows);
    add_batch(words_[batch], row_of_bin, own);
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
