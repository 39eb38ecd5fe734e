#include "design/dots/size_law.h"

#include <algorithm>
#include <cmath>

namespace evenglow::design {
namespace {

constexpr double kSlack = 1.03;

}  // namespace

SizeLaw::SizeLaw(const DotSpec& spec, const CoverageMap& map) : footprint_(spec.footprint) {
  const bool one_size = spec.mode == DotMode::spacing;
  least_ = one_size ? spec.diameter : spec.diameter_min;
  greatest_ = one_size ? spec.diameter : spec.diameter_max;
  if (!one_size && greatest_ > kSlack * kSlack * least_) {
    least_ *= kSlack;
    greatest_ /= kSlack;
  }
  double low = 1.0, high = 0.0;
  for (std::size_t i = 0; i < map.coverage().values.size(); ++i) {
    const double coverage = map.coverage().values[i];
    if (map.free_share(i) <= 0.0 || coverage <= 0.0) continue;
    low = std::min(low, coverage);
    high = std::max(high, coverage);
  }
  low_ = low;
  exponent_ = !one_size && high > low ? std::log(greatest_ / least_) / std::log(high / low) : 0.0;
  widest_ = 2.0 * std::max(map.grid().dx, map.grid().dy);
}

double SizeLaw::diameter(double coverage) const {
  if (exponent_ == 0.0) return least_;
  return std::clamp(least_ * std::pow(std::max(coverage, low_) / low_, exponent_), least_, greatest_);
}

double SizeLaw::area(double coverage) const {
  return core::footprint_area(footprint_, diameter(coverage));
}

double SizeLaw::spacing(double coverage) const {
  if (!(coverage > 0.0)) return widest_;
  return std::min(widest_, std::sqrt(area(coverage) / coverage));
}

}  // namespace evenglow::design
