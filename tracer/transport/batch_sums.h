#pragma once

#include <optional>
#include <vector>

#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// Sums of one batch for each receiver; a batch writes only its own.
struct BatchSums {
  std::vector<double> luminance;    ///< scores, 1/sr
  std::vector<double> energy;       ///< photons
  std::vector<double> angular;      ///< photons
  std::vector<double> events{0.0};  ///< surface interactions

  explicit BatchSums(const Scene& scene)
      : luminance(scene.luminance.bins()),
        energy(scene.energy.bins()),
        angular(scene.angular ? scene.angular->bins() : 0) {}
};

}  // namespace evenglow::tracer
