#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "design/problem/design_spec.h"
#include "design/problem/judgment.h"

namespace evenglow::design {

struct DesignLimits {
  std::uint64_t first_photons = 0;
  std::uint64_t largest_photons = 0;
};

/// What an updater that works on histories can tell of the density to come.
struct Foresight {
  double noise_left = 0.0;  ///< RMS of the traces' noise in it
  double wanted_rms = 0.0;  ///< `stop_rms`, or what limits let the design reach at all
};

/// Photons of the step after the last of `steps`, on `cells` cells of the display. They grow by up to `photon_growth`
/// while noise is in the way.
///
/// With foresight the design is solved up to the noise left in it, however uneven the last step was: photons grow while
/// that is above half of the wanted RMS. Below, the next trace has only to show the RMS, with an error of 0.1 of it as
/// it follows from the noise of a cell (merit.h). Where such a trace shows that the design was not there yet, photons
/// grow again, and fewer do no longer.
///
/// Without: photons grow while the noise of a cell is above the RMS, or the error of the RMS above 0.15 of it.
std::uint64_t next_photons(const std::vector<StepRecord>& steps, std::optional<Foresight> foresight, std::size_t cells,
                           const DesignSpec& spec, const DesignLimits& limits);

}  // namespace evenglow::design
