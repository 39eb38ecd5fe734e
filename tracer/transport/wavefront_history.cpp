#include "tracer/transport/wavefront_history.h"

#include <algorithm>
#include <array>
#include <vector>

#include "tracer/transport/wavefront_outside.h"
#include "tracer/transport/wavefront_plate.h"
#include "tracer/wavefront/plate_kernel.h"

namespace evenglow::tracer {
namespace {

/// Groups of lanes of a batch. From 4 to 64 it takes the same time; few groups leave few lanes idle when it ends.
constexpr std::size_t kGroups = 8;

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
      see_to(group);
    }
    while (busy_ > 0 && !stop.stop_requested()) {
      step_plate(constants_, groups_.data(), groups_.size());
      for (std::size_t group = 0; group < groups_.size(); ++group) see_to(group);
    }
  }

 private:
  using Walk = WavefrontOutside::Walk;

  void see_to(std::size_t group) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // A photon that was reflected when it came to the plate needs to be seen to before it is stepped.
      while (true) {
        const auto exit = static_cast<LaneExit>(groups_[group].exit[lane]);
        if (exit == LaneExit::kNone || exit == LaneExit::kEmpty) break;
        resolve(group, lane, exit);
      }
    }
  }

  void resolve(std::size_t group, std::size_t lane, LaneExit exit) {
    PlateLanes& g = groups_[group];
    Walk& walk = walks_[group * kLanes + lane];
    const auto events = static_cast<std::int64_t>(g.events[lane]);
    if (exit == LaneExit::kAbsorbed) {
      outside_.absorb(static_cast<int>(g.part[lane]), events, walk, sums_);
    } else if (exit == LaneExit::kEscaped) {
      outside_.escape({g.x[lane], g.y[lane], g.z[lane]}, {g.kx[lane], g.ky[lane], g.kz[lane]}, events, walk, sums_);
    } else {
      core::PhotonRng rng({g.random[0][lane], g.random[1][lane], g.random[2][lane], g.random[3][lane]});
      take(g, lane, walk);
      if (outside_.go_on(exit, static_cast<int>(g.side[lane]), walk, rng, sums_)) return put(g, lane, walk, rng);
    }
    --busy_;
    fill(group, lane);
  }

  /// What the kernel holds of a photon.
  void take(const PlateLanes& g, std::size_t lane, Walk& walk) {
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
  }

  /// Gives the lane the next photon.
  void fill(std::size_t group, std::size_t lane) {
    PlateLanes& g = groups_[group];
    if (launched_ == waiting_) launch();
    if (launched_ == waiting_) {
      g.exit[lane] = static_cast<std::uint64_t>(LaneExit::kEmpty);
      return;
    }
    copy_lane(start_, launched_, g, lane);
    walks_[group * kLanes + lane] = start_walks_[launched_++];
    ++busy_;
  }

  /// The next few photons as far as the plate; those that end before need no lane.
  void launch() {
    launched_ = waiting_ = 0;
    while (waiting_ < kLanes && next_ < end_) {
      core::PhotonRng rng(key_, next_++);
      Walk& walk = start_walks_[waiting_];
      int side = -1;
      if (!outside_.start(walk, side, rng, sums_)) continue;
      put(start_, waiting_, walk, rng);
      if (side >= 0) {
        start_.side[waiting_] = side;
        start_.exit[waiting_] = static_cast<std::uint64_t>(LaneExit::kArrives);
      }
      ++waiting_;
    }
    enter_plate(constants_, start_);
  }

  void put(PlateLanes& g, std::size_t lane, const Walk& walk, const core::PhotonRng& rng) {
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
    g.depth[lane] = walk.optical_depth;
    const PlanarProgress& progress = outside_.progress();
    g.missed[lane] = progress.missed;
    g.fate[lane] = progress.fate;
    g.events[lane] = static_cast<double>(progress.events);
    for (std::size_t word = 0; word < 4; ++word) g.random[word][lane] = rng.state()[word];
    g.exit[lane] = static_cast<std::uint64_t>(LaneExit::kNone);
  }

  WavefrontOutside outside_;
  const PlateConstants& constants_;
  const core::RandomKey& key_;
  std::uint64_t next_, end_;
  BatchSums& sums_;
  std::vector<PlateLanes> groups_;
  PlateLanes start_;  ///< photons that wait for a lane
  std::array<Walk, kLanes> start_walks_;
  std::size_t waiting_ = 0, launched_ = 0;  ///< so many of them; so many of these have a lane
  std::vector<Walk> walks_;                 ///< of each lane; without place and light while it is in the plate
  std::size_t busy_ = 0;                    ///< lanes with a photon
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
