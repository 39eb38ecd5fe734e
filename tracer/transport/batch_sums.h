#pragma once

#include <optional>
#include <vector>

#include "tracer/scene/scene.h"
#include "tracer/transport/arrival_log.h"
#include "tracer/transport/viewer_pool.h"

namespace evenglow::tracer {

/// Sums of one batch for each receiver; a batch writes only its own.
struct BatchSums {
  std::size_t cells;              ///< of the display; the bins of `luminance` are these for each direction of view
  std::vector<double> luminance;  ///< scores, 1/sr
  std::vector<double> color_x;    ///< as luminance, for X and Z; empty unless the color is asked for
  std::vector<double> color_z;
  std::vector<double> energy;       ///< luminous weight of photons (1 each with one wavelength)
  std::vector<double> angular;      ///< as energy
  std::vector<double> events{0.0};  ///< surface interactions
  ViewerPools viewer;               ///< what the next-event estimate joins scatters to
  ArrivalLog* log = nullptr;        ///< where the luminance of the photon is taken down, if it is

  explicit BatchSums(const Scene& scene)
      : cells(scene.luminance.cells().size()),
        luminance(scene.luminance.bins()),
        color_x(scene.spec.color ? scene.luminance.bins() : 0),
        color_z(scene.spec.color ? scene.luminance.bins() : 0),
        energy(scene.energy.bins()),
        angular(scene.angular ? scene.angular->bins() : 0) {}

  /// Adds a luminance score of a photon that carries the tristimulus values `weight`.
  void add_luminance(const Score& score, const core::Vec3& weight) {
    luminance[score.bin] += score.weight * weight.y();
    // Records tell what counts, the sum of all directions.
    if (log != nullptr) log->deposit(score.bin < cells ? score.bin : score.bin % cells, score.weight * weight.y());
    if (color_x.empty()) return;
    color_x[score.bin] += score.weight * weight.x();
    color_z[score.bin] += score.weight * weight.z();
  }
};

}  // namespace evenglow::tracer
