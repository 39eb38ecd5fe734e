#pragma once

#include <cstdint>
#include <stop_token>

#include "core/montecarlo/batches.h"
#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_cells.h"
#include "tracer/transport/planar_plate.h"
#include "tracer/transport/planar_scene.h"
#include "tracer/wavefront/plate_constants.h"

namespace evenglow::tracer {

/// Many photons at once, in a stack of parallel layers over a plate: in the plate by the vector kernel
/// (tracer/wavefront), elsewhere one by one by the optics that all paths share. A photon that has left the plate is
/// followed at once until it is in the plate again or ends; then its lane takes the next photon, so that all lanes are
/// busy until a batch runs out. The order within a batch is fixed: same bits on any number of threads and by any
/// instruction set. Statistically equal to `PlanarHistory`, with other random numbers.
class WavefrontHistory {
 public:
  /// For scenes that it serves (`wavefront_serves`); the arguments must outlive it.
  WavefrontHistory(const Scene& scene, const PlanarScene& layout, const DensityField& density);

  /// Traces these photons and adds what they do to `sums`; stops early, with sums of no use, when that is asked for.
  void run(const core::RandomKey& key, const core::BatchRange& photons, BatchSums& sums,
           const std::stop_token& stop = {}) const;
  /// One photon; the same that it does in a batch.
  void run(const core::RandomKey& key, std::uint64_t photon, BatchSums& sums) const {
    run(key, core::BatchRange{0, photon, 1}, sums);
  }

 private:
  const Scene& scene_;
  const PlanarScene& layout_;
  PhotonHistory history_;
  PlanarCells cells_;
  PlanarPlate plate_;
  PlateConstants constants_;
};

}  // namespace evenglow::tracer
