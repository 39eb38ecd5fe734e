#include "tracer/transport/arrival_records.h"

#include <utility>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "tracer/transport/arrival_factors.h"
#include "tracer/transport/arrival_replay.h"

namespace evenglow::tracer {
namespace {

/// The luminance of a batch at another density; after its bins the sum and the squares of the weights at each photon's
/// last deposit.
class ReweightedBatch {
 public:
  ReweightedBatch(const ArrivalFactors& factors, std::size_t bins) : weight_(factors), bins_(bins), sums_(bins + 2) {}

  void arrive(std::uint32_t cell, bool met) { weight_.arrive(cell, met); }
  void cross(std::uint32_t cell) { weight_.cross(cell); }
  void share(std::uint32_t cell) { weight_.share(cell); }
  void deposit(std::uint32_t bin, double amount, bool shared) {
    sums_[bin] += weight_.of_deposit(shared) * amount;
    at_deposit_ = weight_.of_arrivals();
  }
  void end_photon() {
    sums_[bins_] += at_deposit_;
    sums_[bins_ + 1] += at_deposit_ * at_deposit_;
    at_deposit_ = 1.0;
    weight_.end_photon();
  }
  std::vector<double> take() { return std::move(sums_); }

 private:
  HistoryWeight weight_;
  std::size_t bins_;
  std::vector<double> sums_;
  double at_deposit_ = 1.0;
};

/// d/de of the luminance of a batch at density exp(e direction): each deposit times the score of its history.
class DerivedBatch {
 public:
  /// `slope_passed`, `slope_met`: d ln(share of the face bare, under microstructure)/de of each cell.
  DerivedBatch(const ArrivalFactors& factors, const std::vector<double>& slope_passed,
               const std::vector<double>& slope_met, std::size_t bins)
      : weight_(factors), slope_passed_(slope_passed), slope_met_(slope_met), sums_(bins) {}

  void arrive(std::uint32_t cell, bool met) {
    weight_.arrive(cell, met);
    score_ += met ? slope_met_[cell] : slope_passed_[cell];
  }
  void cross(std::uint32_t cell) {
    weight_.cross(cell);
    crossed_score_ += slope_passed_[cell];
  }
  void share(std::uint32_t cell) {
    weight_.share(cell);
    share_score_ = slope_met_[cell];
  }
  void deposit(std::uint32_t bin, double amount, bool shared) {
    const double score = score_ + crossed_score_ + (shared ? share_score_ : 0.0);
    sums_[bin] += weight_.of_deposit(shared) * amount * score;
    crossed_score_ = 0.0;
  }
  void end_photon() {
    weight_.end_photon();
    score_ = crossed_score_ = share_score_ = 0.0;
  }
  std::vector<double> take() { return std::move(sums_); }

 private:
  HistoryWeight weight_;
  const std::vector<double>& slope_passed_;
  const std::vector<double>& slope_met_;
  std::vector<double> sums_;
  double score_ = 0.0, crossed_score_ = 0.0, share_score_ = 0.0;
};

}  // namespace

ArrivalRecords::ArrivalRecords(const DensityField& density, std::size_t bins, int threads, std::vector<ArrivalLog> logs,
                               core::RankGroup* ranks, std::stop_token stop)
    : density_(density), bins_(bins), threads_(threads), ranks_(ranks), stop_(std::move(stop)) {
  std::vector<std::vector<double>> sizes(logs.size());
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::size_t photons = logs[i].photons();
    words_.push_back(logs[i].take());
    sizes[i] = {static_cast<double>(photons), static_cast<double>(words_.back().size() * sizeof(std::uint32_t))};
    if (photons > 0 || ranks_ == nullptr) own_.push_back(i);
  }
  if (ranks_ != nullptr) ranks_->share(own_, sizes, stop_);
  for (const auto& size : sizes) {
    batch_photons_.push_back(static_cast<std::uint64_t>(size[0]));
    photons_ += batch_photons_.back();
    bytes_ += static_cast<std::size_t>(size[1]);
  }
}

std::vector<std::vector<double>> ArrivalRecords::of_batches(
    const std::function<std::vector<double>(std::size_t)>& sum_of) const {
  std::vector<std::vector<double>> sums(words_.size());
  core::run_batches(own_.size(), threads_, [&](std::size_t i) { sums[own_[i]] = sum_of(own_[i]); });
  if (ranks_ != nullptr) ranks_->share(own_, sums, stop_);
  return sums;
}

double ArrivalRecords::batch_scale(std::size_t batch) const {
  const double mean = static_cast<double>(photons_) / static_cast<double>(words_.size());
  return mean / static_cast<double>(batch_photons_[batch]);
}

Reweighted ArrivalRecords::at(const DensityField& density) const {
  const ArrivalFactors factors(density_, density);
  auto sums = of_batches([&](std::size_t batch) {
    ReweightedBatch own(factors, bins_);
    replay(words_[batch], own);
    return own.take();
  });
  Reweighted result{core::Tally(bins_), photons_, 0.0};
  double weight_sum = 0.0, weight_squares = 0.0;
  for (std::size_t batch = 0; batch < words_.size(); ++batch) {
    weight_sum += sums[batch][bins_];
    weight_squares += sums[batch][bins_ + 1];
    sums[batch].resize(bins_);
    for (double& value : sums[batch]) value *= batch_scale(batch);
    result.luminance.add_batch(std::move(sums[batch]));
  }
  if (weight_squares > 0.0)
    result.effective_share = weight_sum * weight_sum / (static_cast<double>(photons_) * weight_squares);
  return result;
}

core::Tally ArrivalRecords::derivative(const DensityField& density, const core::CellField& direction) const {
  const ArrivalFactors factors(density_, density);
  if (direction.grid != density_.cells.grid) throw core::Error("the direction is of other cells of the density");
  std::vector<double> slope_passed = factors.slope_passed;
  for (std::size_t i = 0; i < slope_passed.size(); ++i) slope_passed[i] *= direction.values[i];
  auto sums = of_batches([&](std::size_t batch) {
    DerivedBatch own(factors, slope_passed, direction.values, bins_);
    replay(words_[batch], own);
    return own.take();
  });
  core::Tally result(bins_);
  for (std::size_t batch = 0; batch < words_.size(); ++batch) {
    for (double& value : sums[batch]) value *= batch_scale(batch);
    result.add_batch(std::move(sums[batch]));
  }
  return result;
}

}  // namespace evenglow::tracer
