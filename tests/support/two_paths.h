#pragma once

#include <cstdint>
#include <string>

#include "tests/support/scenes.h"

namespace evenglow::tests {

/// One backlight traced by two paths with different seeds: the general path and the planar one, or any other two.
struct TwoPaths {
  tracer::TraceResult general, planar;
};
TwoPaths traced_by_both(const tracer::Scene& scene, const tracer::DensityField& density, const TraceSetup& setup);
TwoPaths traced_by(tracer::TracePath first, tracer::TracePath second, const tracer::Scene& scene,
                   const tracer::DensityField& density, const TraceSetup& setup);

/// How far the two are from each other.
struct PathDifference {
  double worst_z = 0.0;       ///< greatest |z| of all entries of the energy account and of the mean luminance
  std::string worst_entry;    ///< where it is
  int comparisons = 0;        ///< of them
  double chi_square = 0.0;    ///< of the luminances of cells
  int cells = 0;              ///< of them, with light in both
  double events_ratio = 1.0;  ///< surface interactions, planar over general
};
PathDifference difference_of(const tracer::Scene& scene, const TwoPaths& paths);

}  // namespace evenglow::tests
