#pragma once

#include <cstdint>

#include "bench/bench_scene.h"
#include "bench/cpu_time.h"
#include "bench/natural_light.h"

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_history.h"

namespace evenglow::bench {

using GeneralHistory = tracer::PhotonHistory;
using NaturalPlanarHistory = tracer::BasicPlanarHistory<NaturalLight, tracer::NoArrivalObserver>;

/// A scene with its layers, and the planar history of either kind of light.
template <typename History>
class Planar {
 public:
  explicit Planar(const BenchScene& bench)
      : layers_(*tracer::PlanarScene::of(bench.scene)), history_(bench.scene, layers_, bench.density) {}
  void run(const core::RandomKey& key, std::uint64_t photon, tracer::BatchSums& sums) const {
    history_.run(key, photon, sums);
  }

 private:
  tracer::PlanarScene layers_;
  History history_;
};

/// A general history under the same constructor.
class General {
 public:
  explicit General(const BenchScene& bench) : history_(bench.scene, bench.density) {}
  void run(const core::RandomKey& key, std::uint64_t photon, tracer::BatchSums& sums) const {
    history_.run(key, photon, sums);
  }

 private:
  GeneralHistory history_;
};

/// Photons of one scene, traced slice by slice, some milliseconds each.
template <typename History>
class Walker {
 public:
  explicit Walker(const BenchScene& bench) : history_(bench), sums_(bench.scene) { sums_.viewer.seed({}, 0); }

  void slice(std::uint64_t photons = 500) {
    seconds_ += cpu_seconds_of([&] {
      for (std::uint64_t i = 0; i < photons; ++i) history_.run({}, photons_ + i, sums_);
    });
    photons_ += photons;
  }
  double seconds_per_event() const { return seconds_ / sums_.events[0]; }
  double seconds_per_photon() const { return seconds_ / static_cast<double>(photons_); }
  double events_per_photon() const { return sums_.events[0] / static_cast<double>(photons_); }

 private:
  History history_;
  tracer::BatchSums sums_;
  std::uint64_t photons_ = 0;
  double seconds_ = 0.0;
};

using GeneralWalker = Walker<General>;
using PlanarWalker = Walker<Planar<tracer::PlanarHistory>>;
using NaturalPlanarWalker = Walker<Planar<NaturalPlanarHistory>>;

}  // namespace evenglow::bench
