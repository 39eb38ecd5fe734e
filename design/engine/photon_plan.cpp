#include "design/engine/photon_plan.h"

#include <algorithm>
#include <cmath>

namespace evenglow::design {
namespace {

constexpr double kWantedError = 0.15;  // of the RMS, over the RMS to reach
constexpr double kShownError = 0.1;    // the same, of a trace that has only to show
constexpr double kWantedNoise = 0.5;   // in a density, over the RMS to reach
constexpr double kAgain = 2.0;         // growth after a trace that showed too little
constexpr double kLeastShown = 0.25;   // of the photons before, of a trace that has only to show

double photons_to_see(const StepRecord& record, const DesignSpec& spec) {
  const double wanted = std::max(record.rms_corrected.value, spec.stop_rms);
  const bool more = record.noise > wanted || record.rms_corrected.se > kWantedError * wanted;
  return static_cast<double>(record.photons) * (more ? spec.photon_growth : 1.0);
}

double photons_to_solve(const std::vector<StepRecord>& steps, const Foresight& foresight, std::size_t cells,
                        const DesignSpec& spec) {
  double most = 0.0;
  bool shown = false;  // fewer photons than before: that was to show
  for (const StepRecord& step : steps) {
    const auto photons = static_cast<double>(step.photons);
    shown = shown || photons < most;
    most = std::max(most, photons);
  }
  const double wanted = foresight.wanted_rms;
  const double lacking = std::pow(foresight.noise_left / (kWantedNoise * wanted), 2);
  if (lacking > 1.0) return most * std::min(spec.photon_growth, lacking);
  if (shown) return most * (steps.back().rms_corrected.value > wanted ? std::min(spec.photon_growth, kAgain) : 1.0);
  // The squared RMS of n cells has the error noise^2 sqrt(2/n) where noise is all there is; the RMS that over 2 RMS.
  const double noise = steps.back().noise;
  const double error = std::sqrt(2.0 / static_cast<double>(cells)) * noise * noise / (2.0 * wanted);
  return most * std::clamp(error / (kShownError * wanted), kLeastShown, 1.0);
}

}  // namespace

std::uint64_t next_photons(const std::vector<StepRecord>& steps, std::optional<Foresight> foresight, std::size_t cells,
                           const DesignSpec& spec, const DesignLimits& limits) {
  const double next = foresight ? photons_to_solve(steps, *foresight, cells, spec) : photons_to_see(steps.back(), spec);
  return static_cast<std::uint64_t>(
      std::clamp(next, 1.0, static_cast<double>(std::max<std::uint64_t>(limits.largest_photons, 1))));
}

}  // namespace evenglow::design
