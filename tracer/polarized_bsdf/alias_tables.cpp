#include "tracer/polarized_bsdf/alias_tables.h"

#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace evenglow::tracer {

AliasTables::AliasTables(std::size_t outcomes) : outcomes_(outcomes) {
  core::expects(outcomes >= 1 && outcomes <= kMaxOutcomes, "an alias table has 1 to 4096 outcomes");
}

void AliasTables::add(std::span<const double> weights) {
  core::expects(weights.size() == outcomes_, "one weight for each outcome");
  const std::size_t base = slots_.size();
  for (std::size_t i = 0; i < outcomes_; ++i) {
    slots_.push_back((static_cast<std::uint32_t>(kOne) << kAliasBits) | static_cast<std::uint32_t>(i));
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0.0)) return;
  std::vector<double> share(outcomes_);
  std::vector<std::size_t> small;
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < outcomes_; ++i) {
    share[i] = weights[i] / sum * static_cast<double>(outcomes_);
    (share[i] < 1.0 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t low = small.back();
    const std::size_t high = large.back();
    small.pop_back();
    const auto threshold = static_cast<std::uint32_t>(std::lround(share[low] * kOne));
    slots_[base + low] = (threshold << kAliasBits) | static_cast<std::uint32_t>(high);
    share[high] -= 1.0 - share[low];
    if (share[high] < 1.0) {
      large.pop_back();
      small.push_back(high);
    }
  }
  // What is left differs from 1 by rounding alone: its threshold stays 1.
}

}  // namespace evenglow::tracer
