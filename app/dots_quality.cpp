#include "app/dots_quality.h"

#include <algorithm>

#include "design/dots/dot_index.h"

namespace evenglow::app {

bool DotsQuality::has_visible_beat() const {
  return std::any_of(beats.begin(), beats.end(), [](const design::Beat& beat) { return beat.visible; });
}

DotsQuality judge_dots(const core::DotPattern& dots, const DotsInput& input, const design::FreeArea& free,
                       const design::CoverageMap* map, int threads) {
  constexpr double kDotsInWindow = 600.0;
  DotsQuality quality;
  if (map != nullptr) quality.cells = cell_errors(dots, input.spec.footprint, *map);
  if (dots.size() < 2) return quality;
  const design::DotStore index = design::index_dots(dots, free.bounds(), threads);
  quality.neighbors = design::neighbor_statistics(index, input.spec.footprint, threads);
  const auto windows = design::sample_windows(index, free, kDotsInWindow);
  quality.discrepancy = design::discrepancy_statistics(windows, threads);
  quality.spectrum = design::power_spectrum(windows, threads);
  design::MoireSettings settings;
  settings.viewing_distance = input.spec.viewing_distance;
  quality.beats = design::find_beats(index, free, input.gratings, settings, threads);
  return quality;
}

}  // namespace evenglow::app
