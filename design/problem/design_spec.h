#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/config/config_node.h"

namespace evenglow::design {

/// The map `design` of the run file.
struct DesignSpec {
  std::string target = "uniform";
  std::string updater = "ratio_noise_aware";
  double power = 1.0;      ///< exponent of the ratio updates
  double stop_rms = 0.01;  ///< noise-corrected RMS non-uniformity to reach
  int max_steps = 20;
  double density_min = 0.01;  ///< limits of the density of every cell
  double density_max = 0.8;
  std::optional<double> level;      ///< mean density over the plate; none: as high as the limits allow
  std::uint64_t first_photons = 0;  ///< of the first step; 0: 50 a cell
  double photon_growth = 4.0;       ///< factor from step to step while the noise is larger than the error
};

DesignSpec read_design(const core::ConfigNode& design);

}  // namespace evenglow::design
