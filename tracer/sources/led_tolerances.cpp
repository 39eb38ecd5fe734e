#include "tracer/sources/led_tolerances.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr std::uint32_t kToleranceStream = 0x1ED70;  // keeps the draws apart from those of photons of the same seed

/// Standard normal, cut at kToleranceCut: Box and Muller (Ann. Math. Stat. 29, 1958), drawn anew when beyond.
double cut_normal(core::PhotonRng& rng) {
  while (true) {
    const double radius = std::sqrt(-2.0 * std::log(rng.uniform()));
    const double z = radius * std::cos(2.0 * core::kPi * rng.uniform());
    if (std::abs(z) <= kToleranceCut) return z;
  }
}

std::vector<int> read_off(const core::ConfigNode& node, int count) {
  const auto numbers = node.numbers({"off", "LEDs that stay dark, counted from 1 along the edge",
                                     Range::closed(1, 10000), 0, 10000, std::vector<double>{}, true});
  std::vector<int> off;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int led = static_cast<int>(numbers[i]) - 1;
    if (led >= count) {  // not the declared range, as that is told in the key reference for every row
      node.fault_at(fmt::format("off[{}]", i),
                    fmt::format("must lie in [1, {}], got {} (the row has {} LEDs: its count)", count, led + 1, count));
    }
    if (std::find(off.begin(), off.end(), led) != off.end()) {
      node.fault_at("off", fmt::format("must not name an LED twice, got {} again", led + 1));
    }
    if (led >= 0 && led < count) off.push_back(led);
  }
  if (static_cast<int>(off.size()) >= count) {
    node.fault_at("off", fmt::format("must leave an LED on, got all {} off", count));
  }
  return off;
}

/// A list that is empty or holds a number for each LED.
std::vector<double> read_each(const core::ConfigNode& node, const core::NumbersKey& declaration, int count) {
  std::vector<double> values = node.numbers(declaration);
  if (!values.empty() && static_cast<int>(values.size()) != count) {
    node.fault_at(declaration.key,
                  fmt::format("must hold a number for each of the {} LEDs, got {}", count, values.size()));
    values.clear();
  }
  return values;
}

/// The sum of two lists of which either may be empty.
void add_to(std::vector<double>& values, const std::vector<double>& more) {
  if (values.empty()) values.assign(more.size(), 0.0);
  for (std::size_t i = 0; i < more.size(); ++i) values[i] += more[i];
}

}  // namespace

LedToleranceKeys read_led_tolerances(const core::ConfigNode& node, int count) {
  LedToleranceKeys keys;
  keys.fluxes = node.numbers({"fluxes_lm", "flux of each LED in order along the edge, instead of flux_lm",
                              Range::positive(1e6), 0, 10000, std::vector<double>{}});
  if (node.has("fluxes_lm")) {
    if (node.has("flux_lm")) node.fault_at("fluxes_lm", "must be left out where flux_lm is given, got both");
    if (static_cast<int>(keys.fluxes.size()) != count) {
      node.fault_at("fluxes_lm",
                    fmt::format("must hold a flux for each of the {} LEDs, got {}", count, keys.fluxes.size()));
      keys.fluxes.clear();
    }
  }
  keys.flux_spread = node.number({"flux_spread", "standard deviation of the LEDs' fluxes, relative; cut at 3 of them",
                                  Range::closed(0, 0.3), 0.0});
  keys.position_spread =
      node.number({"position_spread_mm", "standard deviation of the LEDs' places along the edge; cut at 3 of them",
                   Range::closed(0, 100), 0.0});
  keys.seed = static_cast<std::uint64_t>(
      node.integer({"tolerance_seed", "draws other fluxes and places within the spreads", 0, 1LL << 62, 1}));
  keys.off = read_off(node, count);
  const std::vector<double> none;
  keys.factors = read_each(
      node,
      {"flux_factors", "factor on the flux of each LED, in order along the edge", Range::positive(100), 0, 10000, none},
      count);
  keys.offsets = read_each(
      node,
      {"offsets_mm", "shift of each LED along the edge, towards +x or +y", Range::closed(-100, 100), 0, 10000, none},
      count);
  keys.heights = read_each(
      node,
      {"height_offsets_mm", "shift of each LED across the edge, towards +z", Range::closed(-100, 100), 0, 10000, none},
      count);
  return keys;
}

LedTolerances draw_tolerances(const LedToleranceKeys& keys, int count, double flux) {
  LedTolerances result;
  const bool uneven = !keys.fluxes.empty() || keys.flux_spread > 0.0 || !keys.off.empty() || !keys.factors.empty();
  for (int led = 0; led < count; ++led) {
    core::PhotonRng rng({keys.seed, kToleranceStream, 0}, static_cast<std::uint64_t>(led));
    const double brighter = 1.0 + keys.flux_spread * cut_normal(rng);
    const double mean = keys.fluxes.empty() ? flux : keys.fluxes[static_cast<std::size_t>(led)];
    const double factor = keys.factors.empty() ? 1.0 : keys.factors[static_cast<std::size_t>(led)];
    if (uneven) result.fluxes.push_back(mean * brighter * factor);
    const double offset = keys.position_spread * cut_normal(rng);
    if (keys.position_spread > 0.0) result.offsets.push_back(offset);
  }
  add_to(result.offsets, keys.offsets);
  result.heights = keys.heights;
  for (const int led : keys.off) result.fluxes[static_cast<std::size_t>(led)] = 0.0;
  return result;
}

}  // namespace evenglow::tracer
