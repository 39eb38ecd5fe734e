#pragma once

#include <cstdint>

#include "bench/bench_scene.h"
#include "bench/cpu_time.h"

#include "tracer/transport/planar_scene.h"
#include "tracer/transport/wavefront_history.h"
#include "tracer/wavefront/plate_kernel.h"

namespace evenglow::bench {

/// As `Walker`, for the wavefront: a slice is a batch of its own, so that its last photons, which leave lanes idle, are
/// part of what is measured.
class WavefrontWalker {
 public:
  explicit WavefrontWalker(const BenchScene& bench)
      : layers_(*tracer::PlanarScene::of(bench.scene)),
        history_(bench.scene, layers_, bench.density),
        sums_(bench.scene) {
    sums_.viewer.seed({}, 0);
  }

  void slice(std::uint64_t photons) {
    seconds_ += cpu_seconds_of([&] { history_.run({}, core::BatchRange{0, photons_, photons}, sums_); });
    photons_ += photons;
  }
  double seconds_per_event() const { return seconds_ / sums_.events[0]; }
  double seconds_per_photon() const { return seconds_ / static_cast<double>(photons_); }

 private:
  tracer::PlanarScene layers_;
  tracer::WavefrontHistory history_;
  tracer::BatchSums sums_;
  std::uint64_t photons_ = 0;
  double seconds_ = 0.0;
};

}  // namespace evenglow::bench
