#include "design/tolerance/sample_draws.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "design/tolerance/smooth_field.h"

namespace evenglow::design {
namespace {

using Kind = VariationKind;

constexpr std::uint32_t kToleranceStream = 0x701EA;  // keeps the draws apart from those of photons of the same seed
constexpr double kMillimeters = 1e-3;                // of a micrometer

core::PhotonRng generator(const ToleranceSpec& spec, std::size_t variation, int sample) {
  return {{spec.seed, kToleranceStream, static_cast<std::uint32_t>(variation)}, static_cast<std::uint64_t>(sample)};
}

bool is_of_leds(Kind kind) {
  return kind == Kind::led_flux || kind == Kind::led_along || kind == Kind::led_height;
}

bool is_of_each_dot(Kind kind) {
  return kind == Kind::dot_size || kind == Kind::dot_place || kind == Kind::dot_region;
}

std::size_t count_of(const Variation& variation, const Nominal& nominal) {
  if (is_of_each_dot(variation.kind)) return 0;
  if (!is_of_leds(variation.kind)) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < nominal.leds.size(); ++i) {
    if (variation.source < 0 || static_cast<std::size_t>(variation.source) == i)
      count += static_cast<std::size_t>(nominal.leds[i]);
  }
  return count;
}

/// A spread that is a share of the value, as one in its unit.
Distribution absolute(const Variation& variation, double nominal) {
  Distribution result = variation.distribution;
  if (variation.relative) result.spread *= std::abs(nominal);
  return result;
}

struct Moments {
  double mean = 0.0, deviation = 0.0;

  explicit Moments(const std::vector<double>& values) {
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) deviation += (value - mean) * (value - mean) / static_cast<double>(values.size());
    deviation = std::sqrt(deviation);
  }
};

}  // namespace

SampleDraws draw_sample(const ToleranceSpec& spec, const Nominal& nominal, int sample) {
  SampleDraws draws;
  for (std::size_t v = 0; v < spec.variations.size(); ++v) {
    core::PhotonRng rng = generator(spec, v, sample);
    const Distribution distribution = absolute(spec.variations[v], nominal.values[v]);
    std::vector<double>& values = draws.emplace_back(count_of(spec.variations[v], nominal));
    for (double& value : values) value = distribution.draw(rng, nominal.values[v]);
  }
  return draws;
}

SampleDraws extreme_sample(const ToleranceSpec& spec, const Nominal& nominal, bool greatest) {
  SampleDraws draws;
  for (std::size_t v = 0; v < spec.variations.size(); ++v) {
    const Distribution distribution = absolute(spec.variations[v], nominal.values[v]);
    std::vector<double>& values = draws.emplace_back(count_of(spec.variations[v], nominal));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool other = spec.variations[v].kind == Kind::led_along && i % 2 == 1;
      values[i] = greatest != other ? distribution.greatest(nominal.values[v]) : distribution.least(nominal.values[v]);
    }
  }
  return draws;
}

bool varies_dots(const ToleranceSpec& spec) {
  return std::any_of(spec.variations.begin(), spec.variations.end(),
                     [](const Variation& v) { return v.kind == Kind::dot_growth || is_of_each_dot(v.kind); });
}

SampleDots draw_dots(const ToleranceSpec& spec, const SampleDraws& draws, int sample, const core::CellField& density,
                     const DotModel& model) {
  SampleDots result{density, std::vector<core::CellField>(spec.variations.size())};
  DotChange change{core::CellField(density.grid, 0.0)};
  // Generators of their own, for a list without such variations.
  core::PhotonRng sizes = generator(spec, spec.variations.size(), sample), places = sizes;
  for (std::size_t v = 0; v < spec.variations.size(); ++v) {
    const Variation& variation = spec.variations[v];
    const double spread = kMillimeters * variation.distribution.spread;
    if (variation.kind == Kind::dot_growth) {
      for (double& value : change.growth.values) value += kMillimeters * draws[v].front();
    } else if (variation.kind == Kind::dot_size) {
      change.size_spread = std::hypot(change.size_spread, spread);
      sizes = generator(spec, v, sample);
    } else if (variation.kind == Kind::dot_place) {
      change.place_spread = std::hypot(change.place_spread, spread);
      places = generator(spec, v, sample);
    } else if (variation.kind == Kind::dot_region) {
      core::PhotonRng rng = generator(spec, v, sample);
      result.growth[v] = smooth_field(density.grid, variation.length, rng);
      for (std::size_t i = 0; i < density.values.size(); ++i)
        change.growth.values[i] += result.growth[v].values[i] *= spread;
    }
  }
  result.density = changed_density(density, model, change, sizes, places);
  return result;
}

std::vector<std::string> parameter_names(const ToleranceSpec& spec) {
  std::vector<std::string> names;
  for (const Variation& variation : spec.variations) {
    std::string title = title_of(variation);
    const auto same =
        std::count_if(spec.variations.begin(), spec.variations.begin() + (&variation - spec.variations.data()),
                      [&](const Variation& earlier) { return title_of(earlier) == title; });
    if (same > 0) title += fmt::format(" #{}", same + 1);
    if (is_of_leds(variation.kind) || variation.kind == Kind::dot_region) {
      names.push_back(title + ", mean");
      names.push_back(title + ", spread");
    } else if (!is_of_each_dot(variation.kind)) {
      names.push_back(title);
    }
  }
  return names;
}

std::vector<double> parameters_of(const ToleranceSpec& spec, const SampleDraws& draws,
                                  const std::vector<core::CellField>& growth) {
  std::vector<double> parameters;
  for (std::size_t v = 0; v < spec.variations.size(); ++v) {
    const Kind kind = spec.variations[v].kind;
    if (is_of_leds(kind) || kind == Kind::dot_region) {
      const Moments moments(kind == Kind::dot_region ? growth[v].values : draws[v]);
      const double unit = kind == Kind::dot_region ? 1.0 / kMillimeters : 1.0;
      parameters.push_back(moments.mean * unit);
      parameters.push_back(moments.deviation * unit);
    } else if (!is_of_each_dot(kind)) {
      parameters.push_back(draws[v].front());
    }
  }
  return parameters;
}

}  // namespace evenglow::design
