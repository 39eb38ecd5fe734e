#include "design/engine/level_search.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace evenglow::design {
namespace {

constexpr double kFactors[] = {0.4, 0.63, 1.0, 1.6, 2.5};
constexpr double kRoom = 0.75;                     // largest density of a candidate, over the upper limit
constexpr double kNearBest = 0.98;                 // of the best efficiency
constexpr std::uint32_t kFirstStep = 0x80000000U;  // random numbers of their own

tracer::DensityField scaled(tracer::DensityField density, double factor, const DesignSpec& spec) {
  for (double& value : density.cells.values) value *= factor;
  return tracer::clamped(std::move(density), spec.density_min, spec.density_max);
}

struct Candidate {
  double factor;
  double level;
  core::Estimate efficiency;
};

}  // namespace

std::optional<LevelChoice> choose_level(const ForwardModel& model, const tracer::DensityField& density,
                                        const DesignSpec& spec, std::uint64_t photons) {
  std::vector<Candidate> candidates;
  std::uint32_t step = kFirstStep;
  for (const double factor : kFactors) {
    if (factor > 1.0 && factor * density.cells.max() > kRoom * spec.density_max) break;
    const tracer::DensityField candidate = scaled(density, factor, spec);
    const auto observation = model(candidate, photons, step++);
    if (!observation) return std::nullopt;
    candidates.push_back({factor, candidate.cells.mean(), observation->efficiency});
  }
  double best = 0.0;
  for (const Candidate& c : candidates) best = std::max(best, c.efficiency.value);
  const auto chosen = std::find_if(candidates.begin(), candidates.end(),
                                   [&](const Candidate& c) { return c.efficiency.value >= kNearBest * best; });
  LevelChoice choice;
  choice.factor = chosen->factor;
  choice.note = "Level of the density, efficiency at mean density";
  for (const Candidate& c : candidates) {
    choice.note +=
        fmt::format(" {:.3f}: {:.2f} +- {:.2f} %,", c.level, 100.0 * c.efficiency.value, 100.0 * c.efficiency.se);
  }
  choice.note += fmt::format(" chosen {:.3f}, the lowest within 2 % of the best.", chosen->level);
  return choice;
}

}  // namespace evenglow::design
