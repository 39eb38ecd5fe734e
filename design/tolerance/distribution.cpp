#include "design/tolerance/distribution.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;

constexpr std::size_t kMostChoices = 1000;
constexpr const char* kNormalHelp = "standard deviation of a normal distribution, cut at 3 of them";

std::vector<double> shares_of(const ConfigNode& node, std::size_t count) {
  const auto weights = node.numbers({"weights", "how often each of the choices comes, any unit; left out: all alike",
                                     Range::closed(0, 1e9), 0, kMostChoices, std::vector<double>{}});
  if (count > 0 && !weights.empty() && weights.size() != count)
    node.fault_at("weights",
                  fmt::format("must hold a number for each of the {} choices, got {}", count, weights.size()));
  std::vector<double> shares;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) shares.push_back(sum += i < weights.size() ? weights[i] : weights.empty());
  if (count > 0 && !(sum > 0.0)) {
    node.fault_at("weights", "must not all be 0");
    return shares;
  }
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

double draw_normal(core::PhotonRng& rng) {
  const double radius = std::sqrt(-2.0 * std::log(rng.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * rng.uniform());
}

double Distribution::draw(core::PhotonRng& rng, double nominal) const {
  const double middle = mean.value_or(nominal);
  if (kind == Kind::uniform) return middle + spread * (2.0 * rng.uniform() - 1.0);
  if (kind == Kind::choices) {
    const auto found = std::upper_bound(shares.begin(), shares.end() - 1, rng.uniform());
    return choices[static_cast<std::size_t>(found - shares.begin())];
  }
  double z = draw_normal(rng);
  while (std::abs(z) > kDistributionCut) z = draw_normal(rng);
  return middle + spread * z;
}

double Distribution::least(double nominal) const {
  if (kind == Kind::choices) return *std::min_element(choices.begin(), choices.end());
  return mean.value_or(nominal) - spread * (kind == Kind::normal ? kDistributionCut : 1.0);
}

double Distribution::greatest(double nominal) const {
  if (kind == Kind::choices) return *std::max_element(choices.begin(), choices.end());
  return mean.value_or(nominal) + spread * (kind == Kind::normal ? kDistributionCut : 1.0);
}

Distribution read_distribution(const ConfigNode& node, double most) {
  Distribution result;
  const auto normal = node.optional_number({"normal", kNormalHelp, Range::closed(0, most)});
  const auto uniform =
      node.optional_number({"uniform", "half the width of a uniform distribution", Range::closed(0, most)});
  result.choices =
      node.numbers({"choices", "values of which each sample (each LED) gets one, as the bins of a supplier",
                    Range::closed(-1e6, 1e6), 0, kMostChoices, std::vector<double>{}});
  result.shares = shares_of(node, result.choices.size());
  result.mean = node.optional_number(
      {"mean", "middle of the distribution; left out: the nominal value", Range::closed(-1e6, 1e6)});
  const bool kinds[] = {node.has("normal"), node.has("uniform"), node.has("choices")};
  const auto given = std::count(std::begin(kinds), std::end(kinds), true);
  if (given != 1)
    node.fault(fmt::format("must have one of normal, uniform and choices, got {}", given == 0 ? "none" : "several"));
  if (node.has("choices") && result.choices.empty()) node.fault_at("choices", "must hold at least one value, got none");
  if (node.has("choices") && node.has("mean")) node.fault_at("mean", "must not stand beside choices, got both");
  if (!node.has("choices") && node.has("weights")) node.fault_at("weights", "belongs to choices, got none of them");
  if (!result.choices.empty()) {
    result.kind = Distribution::Kind::choices;
  } else if (uniform) {
    result.kind = Distribution::Kind::uniform;
    result.spread = *uniform;
  } else {
    result.spread = normal.value_or(0.0);
  }
  return result;
}

double read_deviation(const ConfigNode& node, double most) {
  return node.number({"normal", "standard deviation of a normal distribution", Range::closed(0, most), {}});
}

}  // namespace evenglow::design
