#include "design/tolerance/tolerance_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "design/tolerance/figures.h"

namespace evenglow::design {
namespace {

std::vector<core::Estimate> seen_of(const ToleranceSamples& run, std::size_t figure) {
  std::vector<core::Estimate> values;
  values.reserve(run.samples.size());
  for (const SampleResult& s : run.samples) values.push_back(s.figures[figure]);
  return values;
}

/// The noise of the uniformities from the halves of the traces: their errors replaced, their shift told.
core::Estimate take_halves(const ToleranceSamples& run, std::array<double, 2> HalfTraces::*halves,
                           std::vector<core::Estimate>& seen) {
  std::vector<std::array<double, 2>> pairs;
  std::vector<double> wholes;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    pairs.push_back(run.samples[i].halves.*halves);
    wholes.push_back(seen[i].value);
  }
  const HalfNoise noise = noise_of_halves(pairs, wholes);
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i].se = noise.se[i];
  return noise.shift;
}

FigureSummary summary_of(const ToleranceSpec& spec, const ToleranceSamples& run, std::size_t figure) {
  FigureSummary summary;
  auto seen = seen_of(run, figure);
  const auto index = static_cast<int>(figure);
  if (index == figure_index("uniformity_9")) summary.shift = take_halves(run, &HalfTraces::nine, seen);
  if (index == figure_index("uniformity_13")) summary.shift = take_halves(run, &HalfTraces::thirteen, seen);
  // One noise for all samples: what it shifts cannot be told from it.
  if (spec.common_numbers) summary.shift = {};
  summary.population = population_of(seen, spec.common_numbers);
  summary.corrected = without_noise(seen, summary.population, summary.shift.value);
  std::vector<std::vector<double>> parameters;
  std::vector<double> values;
  for (const SampleResult& s : run.samples) {
    parameters.push_back(s.parameters);
    values.push_back(s.figures[figure].value);
  }
  if (!parameters.front().empty()) summary.sensitivity = sensitivity(parameters, values);
  return summary;
}

/// How far the sample keeps its tightest limit, in standard deviations; < 0: it misses it.
double margin(const std::vector<LimitedFigure>& limited, const std::vector<double>& deviations, std::size_t sample) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < limited.size(); ++i) {
    const double value = limited[i].seen[sample].value, unit = deviations[i] > 0.0 ? deviations[i] : 1.0;
    const Limit& limit = limited[i].limit;
    if (limit.min) least = std::min(least, (value - *limit.min) / unit);
    if (limit.max) least = std::min(least, (*limit.max - value) / unit);
  }
  return least;
}

}  // namespace

ToleranceSummary summarize(const ToleranceSpec& spec, const ToleranceSamples& run) {
  ToleranceSummary summary;
  for (std::size_t f = 0; f < kFigures.size(); ++f) summary.figures.push_back(summary_of(spec, run, f));
  std::vector<LimitedFigure> limited;
  std::vector<double> deviations;
  for (const Limit& limit : spec.limits) {
    const auto f = static_cast<std::size_t>(figure_index(limit.figure));
    limited.push_back({limit, seen_of(run, f), summary.figures[f].corrected, summary.figures[f].shift.value});
    for (core::Estimate& e : limited.back().seen) e.se = summary.figures[f].population.noise;
    deviations.push_back(summary.figures[f].population.seen);
    summary.yields.push_back(yield_of({limited.back()}));
  }
  if (!limited.empty()) summary.all = yield_of(limited);
  std::vector<double> rank;
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    rank.push_back(limited.empty() ? -run.samples[i].figures[0].value : margin(limited, deviations, i));
  summary.worst.resize(run.samples.size());
  std::iota(summary.worst.begin(), summary.worst.end(), 1);
  std::stable_sort(summary.worst.begin(), summary.worst.end(), [&](int a, int b) {
    return rank[static_cast<std::size_t>(a - 1)] < rank[static_cast<std::size_t>(b - 1)];
  });
  return summary;
}

}  // namespace evenglow::design
