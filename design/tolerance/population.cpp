#include "design/tolerance/population.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

double signed_root(double value) {
  return std::copysign(std::sqrt(std::abs(value)), value);
}

}  // namespace

Population population_of(const std::vector<core::Estimate>& samples, bool common) {
  core::expects(samples.size() >= 3, "a population needs three samples");
  Population p;
  p.count = samples.size();
  const auto n = static_cast<double>(samples.size());
  std::vector<double> sorted;
  double noise = 0.0;
  for (const core::Estimate& s : samples) {
    p.mean.value += s.value / n;
    noise += s.se * s.se / n;
    sorted.push_back(s.value);
  }
  double m2 = 0.0, m4 = 0.0, of_noise = 0.0;
  for (const core::Estimate& s : samples) {
    const double square = (s.value - p.mean.value) * (s.value - p.mean.value);
    m2 += square / n;
    m4 += square * square / n;
    of_noise += (s.se * s.se - noise) * (s.se * s.se - noise) / n;
  }
  const double variance = m2 * n / (n - 1.0);
  const double of_seen = std::max(0.0, (m4 - (n - 3.0) / (n - 1.0) * variance * variance) / n);
  const double of_variance = std::sqrt(of_seen + (common ? 0.0 : of_noise / n));
  const double own = common ? variance : variance - noise;
  p.mean.se = std::sqrt(variance / n);
  p.seen = std::sqrt(variance);
  p.noise = std::sqrt(noise);
  p.spread.value = signed_root(own);
  // To first order; near zero the interval below tells what is known.
  p.spread.se = 0.5 * of_variance / std::sqrt(std::max(std::abs(own), of_variance));
  if (!(of_variance > 0.0)) p.spread.se = 0.0;
  p.spread_low = signed_root(own - 1.96 * of_variance);
  p.spread_high = signed_root(own + 1.96 * of_variance);
  std::sort(sorted.begin(), sorted.end());
  p.least = sorted.front();
  p.greatest = sorted.back();
  p.median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  return p;
}

std::vector<double> without_noise(const std::vector<core::Estimate>& samples, const Population& population,
                                  double shift) {
  const double factor = population.seen > 0.0 ? std::max(0.0, population.spread.value) / population.seen : 0.0;
  std::vector<double> values;
  values.reserve(samples.size());
  for (const core::Estimate& s : samples)
    values.push_back(population.mean.value + (s.value - population.mean.value) * factor - shift);
  return values;
}

}  // namespace evenglow::design
