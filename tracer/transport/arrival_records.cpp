#include "tracer/transport/arrival_records.h"

#include <bit>
#include <utility>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "tracer/transport/arrival_factors.h"

namespace evenglow::tracer {
namespace {

constexpr std::uint32_t kIndexMask = ArrivalLog::kMostIndex;

LogKind kind_of(std::uint32_t word) {
  return static_cast<LogKind>(word >> ArrivalLog::kKindShift);
}

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
  // After the bins of a batch, what its weights come to.
  auto sums = of_batches([&](std::size_t batch) {
    std::vector<double> own(bins_ + 2, 0.0);
    double weight = 1.0, at_deposit = 1.0, crossed = 1.0, share = 1.0;
    const std::uint32_t* const end = words_[batch].data() + words_[batch].size();
    for (const std::uint32_t* at = words_[batch].data(); at != end; ++at) {
      const std::uint32_t index = *at & kIndexMask;
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
          own[index] += weight * crossed * static_cast<double>(std::bit_cast<float>(*++at));
          at_deposit = weight;
          crossed = 1.0;
          break;
        case LogKind::kShared:
          own[index] += weight * share * crossed * static_cast<double>(std::bit_cast<float>(*++at));
          at_deposit = weight;
          crossed = 1.0;
          break;
        case LogKind::kPhotonEnd:
          own[bins_] += at_deposit;
          own[bins_ + 1] += at_deposit * at_deposit;
          weight = at_deposit = crossed = share = 1.0;
          break;
      }
    }
    return own;
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
    std::vector<double> own(bins_, 0.0);
    double weight = 1.0, slope = 0.0, crossed = 1.0, crossed_slope = 0.0, share = 1.0, share_slope = 0.0;
    const auto deposit = [&](std::uint32_t bin, float amount, double factor, double own_slope) {
      own[bin] += weight * crossed * factor * static_cast<double>(amount) * (slope + crossed_slope + own_slope);
      crossed = 1.0;
      crossed_slope = 0.0;
    };
    const std::uint32_t* const end = words_[batch].data() + words_[batch].size();
    for (const std::uint32_t* at = words_[batch].data(); at != end; ++at) {
      const std::uint32_t index = *at & kIndexMask;
      switch (kind_of(*at)) {
        case LogKind::kPassed:
          weight *= factors.passed[index];
          slope += slope_passed[index];
          break;
        case LogKind::kMet:
          weight *= factors.met[index];
          slope += direction.values[index];
          break;
        case LogKind::kCrossed:
          crossed *= factors.passed[index];
          crossed_slope += slope_passed[index];
          break;
        case LogKind::kShare:
          share = factors.met[index];
          share_slope = direction.values[index];
          break;
        case LogKind::kDeposit:
          deposit(index, std::bit_cast<float>(*++at), 1.0, 0.0);
          break;
        case LogKind::kShared:
          deposit(index, std::bit_cast<float>(*++at), share, share_slope);
          break;
        case LogKind::kPhotonEnd:
          weight = crossed = 1.0;
          slope = crossed_slope = 0.0;
          break;
      }
    }
    return own;
  });
  core::Tally result(bins_);
  for (std::size_t batch = 0; batch < words_.size(); ++batch) {
    for (double& value : sums[batch]) value *= batch_scale(batch);
    result.add_batch(std::move(sums[batch]));
  }
  return result;
}

}  // namespace evenglow::tracer
