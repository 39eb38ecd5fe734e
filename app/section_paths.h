#pragma once

#include <cstdint>

#include "core/montecarlo/photon_rng.h"
#include "design/report/section_view.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"

namespace evenglow::app {

/// What stretch of the backlight is drawn, and whose ways.
struct SectionOptions {
  core::RandomKey key;
  int photons = 12;       ///< ways to draw
  double from = 0.0;      ///< mm, along x
  double to = 0.0;        ///< mm; not above `from`: a stretch of a few thicknesses
  int most_events = 400;  ///< of a way
};

/// The stack in section with the ways of the first photons of a trace that can be seen in the stretch.
design::SectionView section_view(const tracer::Scene& scene, const tracer::DensityField& density,
                                 const SectionOptions& options);

}  // namespace evenglow::app
