#include "tracer/transport/wavefront_history.h"

#include <vector>

#include "tracer/transport/wavefront_outside.h"
#include "tracer/transport/wavefront_plate.h"
#include "tracer/wavefront/plate_kernel.h"

namespace evenglow::tracer {
namespace {

/// Groups of lanes of a batch: enough that what the kernel needs once is shared, few enough for the first cache.
constexpr std::size_t kGroups = 16;

/// The photons of one batch in their lanes.
class Batch {
 public:
  Batch(const WavefrontOutside& outside, const PlateConstants& constants, const core::RandomKey& key,
        const core::BatchRange& photons, BatchSums& sums)
      : outside_(outside),
        constants_(constants),
        key_(key),
        next_(photons.first),
        end_(photons.first + photons.count),
        sums_(sums),
        groups_(std::min(kGroups, static_cast<std::size_t>((photons.count + kLanes - 1) / kLanes))),
        walks_(groups_.size() * kLanes) {}

  void run(const std::stop_token& stop) {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) fill(group, lane);
    }
    while (busy_ > 0 && !stop.stop_requested()) {
      step_plate(constants_, groups_.data(), groups_.size());
      for (std::size_t group = 0; group < groups_.size(); ++group) see_to(group);
    }
  }

 private:
  void see_to(std::size_t group) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto exit = static_cast<LaneExit>(groups_[group].exit[lane]);
      if (exit != LaneExit::kNone && exit != LaneExit::kEmpty) resolve(group, lane, exit);
    }
  }

  void resolve(std::size_t group, std::size_t lane, LaneExit exit) {
    PlateLanes& g = groups_[group];
    Walk& walk = walks_[group * kLanes + lane];
    auto& s = outside_.state();
    s.x = g.x[lane];
    s.y = g.y[lane];
    s.z = g.z[lane];
    s.light.kx = g.kx[lane];
    s.light.ky = g.ky[lane];
    s.light.kz = g.kz[lane];
    s.light.I = g.I[lane];
    s.light.Q = g.Q[lane];
    s.light.U = g.U[lane];
    s.light.V = g.V[lane];
    walk.optical_depth = g.depth[lane];
    PlanarProgress& progress = outside_.progress();
    progress.missed = g.missed[lane];
    progress.fate = g.fate[lane];
    progress.events = static_cast<std::int64_t>(g.events[lane]);
    core::PhotonRng rng({g.random[0][lane], g.random[1][lane], g.random[2][lane], g.random[3][lane]});
    const int side = static_cast<int>(g.side[lane]);
    const int part = static_cast<int>(g.part[lane]);
    if (outside_.go_on(exit, side, part, walk, rng, sums_)) return put(group, lane, rng);
    --busy_;
    fill(group, lane);
  }

  /// The next photons, until one is in the plate.
  void fill(std::size_t group, std::size_t lane) {
    while (next_ < end_) {
      core::PhotonRng rng(key_, next_++);
      if (!outside_.start(walks_[group * kLanes + lane], rng, sums_)) continue;
      ++busy_;
      return put(group, lane, rng);
    }
    groups_[group].exit[lane] = static_cast<std::uint64_t>(LaneExit::kEmpty);
  }

  void put(std::size_t group, std::size_t lane, const core::PhotonRng& rng) {
    PlateLanes& g = groups_[group];
    const auto& s = outside_.state();
    g.x[lane] = s.x;
    g.y[lane] = s.y;
    g.z[lane] = s.z;
    g.kx[lane] = s.light.kx;
    g.ky[lane] = s.light.ky;
    g.kz[lane] = s.light.kz;
    g.I[lane] = s.light.I;
    g.Q[lane] = s.light.Q;
    g.U[lane] = s.light.U;
    g.V[lane] = s.light.V;
    g.depth[lane] = walks_[group * kLanes + lane].optical_depth;
    const PlanarProgress& progress = outside_.progress();
    g.missed[lane] = progress.missed;
    g.fate[lane] = progress.fate;
    g.events[lane] = static_cast<double>(progress.events);
    for (std::size_t word = 0; word < 4; ++word) g.random[word][lane] = rng.state()[word];
    g.exit[lane] = static_cast<std::uint64_t>(LaneExit::kNone);
  }

  using Walk = WavefrontOutside::Walk;
  WavefrontOutside outside_;
  const PlateConstants& constants_;
  const core::RandomKey& key_;
  std::uint64_t next_, end_;
  BatchSums& sums_;
  std::vector<PlateLanes> groups_;
  std::vector<Walk> walks_;  ///< of each lane; without place and light while it is in the plate
  std::size_t busy_ = 0;     ///< lanes with a photon
};

}  // namespace

WavefrontHistory::WavefrontHistory(const Scene& scene, const PlanarScene& layout, const DensityField& density)
    : scene_(scene),
      layout_(layout),
      history_(scene, density),
      cells_(density),
      plate_(*PlanarPlate::of(scene, layout, 0)),
      constants_(plate_constants(scene, layout, plate_, density)) {}

void WavefrontHistory::run(const core::RandomKey& key, const core::BatchRange& photons, BatchSums& sums,
                           const std::stop_token& stop) const {
  const WavefrontOutside outside(scene_, layout_, history_, plate_, cells_);
  Batch(outside, constants_, key, photons, sums).run(stop);
}

}  // namespace evenglow::tracer
