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

struct BatchWeights {
  double sum = 0.0, squares = 0.0;
};

}  // namespace

ArrivalRecords::ArrivalRecords(const DensityField& density, std::size_t bins, int threads, std::vector<ArrivalLog> logs)
    : density_(density), bins_(bins), threads_(threads) {
  for (ArrivalLog& log : logs) {
    photons_ += log.photons();
    batch_photons_.push_back(log.photons());
    words_.push_back(log.take());
  }
}

std::size_t ArrivalRecords::bytes() const {
  std::size_t sum = 0;
  for (const auto& batch : words_) sum += batch.size() * sizeof(std::uint32_t);
  return sum;
}

double ArrivalRecords::batch_scale(std::size_t batch) const {
  const double mean = static_cast<double>(photons_) / static_cast<double>(words_.size());
  return mean / static_cast<double>(batch_photons_[batch]);
}

Reweighted ArrivalRecords::at(const DensityField& density) const {
  const ArrivalFactors factors(density_, density);
  std::vector<std::vector<double>> sums(words_.size());
  std::vector<BatchWeights> weights(words_.size());
  core::run_batches(words_.size(), threads_, [&](std::size_t batch) {
    std::vector<double> own(bins_, 0.0);
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
          weights[batch].sum += at_deposit;
          weights[batch].squares += at_deposit * at_deposit;
          weight = at_deposit = crossed = share = 1.0;
          break;
      }
    }
    sums[batch] = std::move(own);
  });
  Reweighted result{core::Tally(bins_), photons_, 0.0};
  BatchWeights all;
  for (std::size_t batch = 0; batch < words_.size(); ++batch) {
    all.sum += weights[batch].sum;
    all.squares += weights[batch].squares;
    for (double& value : sums[batch]) value *= batch_scale(batch);
    result.luminance.add_batch(std::move(sums[batch]));
  }
  if (all.squares > 0.0) result.effective_share = all.sum * all.sum / (static_cast<double>(photons_) * all.squares);
  return result;
}

core::Tally ArrivalRecords::derivative(const DensityField& density, const core::CellField& direction) const {
  const ArrivalFactors factors(density_, density);
  if (direction.grid != density_.cells.grid) throw core::Error("the direction is of other cells of the density");
  std::vector<double> slope_passed = factors.slope_passed;
  for (std::size_t i = 0; i < slope_passed.size(); ++i) slope_passed[i] *= direction.values[i];
  std::vector<std::vector<double>> sums(words_.size());
  core::run_batches(words_.size(), threads_, [&](std::size_t batch) {
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
    sums[batch] = std::move(own);
  });
  core::Tally result(bins_);
  for (std::size_t batch = 0; batch < words_.size(); ++batch) {
    for (double& value : sums[batch]) value *= batch_scale(batch);
    result.add_batch(std::move(sums[batch]));
  }
  return result;
}

}  // namespace evenglow::tracer
