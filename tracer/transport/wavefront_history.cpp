#include "tracer/transport/wavefront_history.h"

#include <algorithm>
#include <vector>

#include "tracer/transport/wavefront_outside.h"
#include "tracer/transport/wavefront_plate.h"
#include "tracer/wavefront/plate_kernel.h"

namespace evenglow::tracer {
namespace {

/// Groups of lanes of a batch. From 2 to 32 it takes the same time; few groups leave few lanes idle when it ends.
constexpr std::size_t kGroups = 4;

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
        start_photons_(kLanes, Photon{{}, core::PhotonRng(key, 0)}),
        photons_(groups_.size() * kLanes, start_photons_.front()) {}

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
  /// What the kernel does not hold of a photon.
  struct Photon {
    Walk walk;  ///< without place and light while the photon is in the plate
    core::PhotonRng rng;
  };

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
    Photon& photon = photons_[group * kLanes + lane];
    const auto events = static_cast<std::int64_t>(g.events[lane]);
    if (exit == LaneExit::kAbsorbed) {
      outside_.absorb(static_cast<int>(g.part[lane]), events, photon.walk, sums_);
    } else if (exit == LaneExit::kEscaped) {
      outside_.escape({g.x[lane], g.y[lane], g.z[lane]}, {g.kx[lane], g.ky[lane], g.kz[lane]}, events, photon.walk,
                      sums_);
    } else {
      take(g, lane, photon.walk);
      if (outside_.go_on(exit, static_cast<int>(g.side[lane]), photon.walk, photon.rng, sums_)) {
        return put(g, lane, photon.walk);
      }
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
    // In double precision again: a unit vector, and no more polarization than there is light.
    const core::Vec3 k = core::Vec3(g.kx[lane], g.ky[lane], g.kz[lane]).normalized();
    const core::Vec3 polarization(g.Q[lane], g.U[lane], g.V[lane]);
    s.light.kx = k.x();
    s.light.ky = k.y();
    s.light.kz = k.z();
    s.light.I = std::max(static_cast<double>(g.I[lane]), polarization.norm());
    s.light.Q = polarization.x();
    s.light.U = polarization.y();
    s.light.V = polarization.z();
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
      g.exit[lane] = static_cast<std::uint32_t>(LaneExit::kEmpty);
      return;
    }
    copy_lane(start_, launched_, g, lane);
    photons_[group * kLanes + lane] = start_photons_[launched_++];
    ++busy_;
  }

  /// The next few photons as far as the plate; those that end before need no lane.
  void launch() {
    launched_ = waiting_ = 0;
    while (waiting_ < kLanes && next_ < end_) {
      const std::uint64_t index = next_++;
      Photon& photon = start_photons_[waiting_];
      photon.rng = core::PhotonRng(key_, index);
      int side = -1;
      if (!outside_.start(photon.walk, side, photon.rng, sums_)) continue;
      put(start_, waiting_, photon.walk);
      const auto words = core::lane_words(key_, index);
      for (std::size_t word = 0; word < 4; ++word) start_.random[word][waiting_] = words[word];
      if (side >= 0) {
        start_.side[waiting_] = static_cast<float>(side);
        start_.exit[waiting_] = static_cast<std::uint32_t>(LaneExit::kArrives);
      }
      ++waiting_;
    }
    enter_plate(constants_, start_);
  }

  void put(PlateLanes& g, std::size_t lane, const Walk& walk) {
    const auto number = [](double value) { return static_cast<float>(value); };
    const auto& s = outside_.state();
    g.x[lane] = number(s.x);
    g.y[lane] = number(s.y);
    g.z[lane] = number(s.z);
    g.kx[lane] = number(s.light.kx);
    g.ky[lane] = number(s.light.ky);
    g.kz[lane] = number(s.light.kz);
    const double per_unit = 1.0 / s.light.I;  // of any size in double precision
    g.I[lane] = 1.0F;
    g.Q[lane] = number(s.light.Q * per_unit);
    g.U[lane] = number(s.light.U * per_unit);
    g.V[lane] = number(s.light.V * per_unit);
    g.depth[lane] = number(walk.optical_depth);
    const PlanarProgress& progress = outside_.progress();
    g.missed[lane] = number(progress.missed);
    g.fate[lane] = number(progress.fate);
    g.events[lane] = number(static_cast<double>(progress.events));
    g.exit[lane] = static_cast<std::uint32_t>(LaneExit::kNone);
  }

  PlateLanes start_;  ///< photons that wait for a lane
  WavefrontOutside outside_;
  const PlateConstants& constants_;
  const core::RandomKey& key_;
  std::uint64_t next_, end_;
  BatchSums& sums_;
  std::vector<PlateLanes> groups_;
  std::vector<Photon> start_photons_;
  std::size_t waiting_ = 0, launched_ = 0;  ///< so many of them; so many of these have a lane
  std::vector<Photon> photons_;             ///< of each lane
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
