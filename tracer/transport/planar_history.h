#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_cells.h"
#include "tracer/transport/planar_dots.h"
#include "tracer/transport/planar_plate_walk.h"
#include "tracer/transport/planar_scene.h"

namespace evenglow::tracer {

/// One photon from birth to absorption or escape in a stack of parallel layers: the physics of `PhotonHistory` with
/// flights in closed form. `Light`: MeridianLight, or one that knows less (bench/). `Observer`: is told of each arrival
/// at the patterned face (`PatternArrival`). `Cells`: `PlanarCells`, or `PlanarDots` for a pattern that is traced dot
/// by dot.
template <typename Light = MeridianLight, typename Observer = NoArrivalObserver, typename Cells = PlanarCells>
class BasicPlanarHistory {
 public:
  BasicPlanarHistory(const Scene& scene, const PlanarScene& layout, const DensityField& density)
      : scene_(scene), layout_(layout), history_(scene, density), cells_(scene, density) {
    for (std::size_t band = 0; band < scene.optics.size(); ++band) {
      plates_.push_back(PlanarPlate::of(scene, layout, band));
      layers_.push_back(plates_.back() ? PlanarLayers(scene, layout, *plates_.back(), band) : PlanarLayers());
    }
  }

  /// Traces the photon with this index and adds what it does to `sums`.
  void run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums) const {
    Observer nobody;
    run(key, photon_index, sums, nobody);
  }
  void run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums, Observer& observer) const {
    core::PhotonRng rng(key, photon_index);
    Walk walk = history_.start(rng);
    const auto& plate = plates_[walk.band];
    PlanarProgress progress;
    bool alive = true;
    walk.told = plate ? NextEvent::PatternTold::kDone : NextEvent::PatternTold::kEach;
    if (plate) {
      if (history_.next_event().estimates_pattern(walk.band)) {
        progress.owed = history_.next_event().number(walk.band, sums);
      }
      if (plate->pattern != nullptr) progress.begin_pattern(rng);
      PlateWalk in_plate(*plate, layers_[walk.band], cells_.of(walk.band), history_, scene_, observer);
      if (const auto wall = layout_.wall_ahead(walk.photon)) {  // as most photons do
        ++progress.events;
        alive = in_plate.enter(walk, *wall, plate->side_of(wall->quad), progress, rng, sums);
      }
      while (alive && progress.events < PhotonHistory::kMaxEvents) {
        alive = walk.photon.body == plate->body ? in_plate.run(walk, progress, rng, sums)
                                                : step(walk, &in_plate, progress, rng, sums);
      }
    } else {
      while (alive && progress.events < PhotonHistory::kMaxEvents) alive = step(walk, nullptr, progress, rng, sums);
    }
    sums.events[0] += static_cast<double>(progress.events);
    if (alive) sums.energy[scene_.energy.lost_bin(LossReason::kStuck)] += 1.0;
  }

 private:
  using Walk = PhotonHistory::Walk;
  using PlateWalk = PlanarPlateWalk<Light, Observer, typename Cells::Band>;

  /// One flight outside the plate and what is met at its end; in the plate, the way through it.
  bool step(Walk& walk, PlateWalk* in_plate, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) const {
    ++progress.events;
    const std::optional<RayHit> hit = layout_.next_hit(walk.photon);
    if (!hit) return history_.step(walk, rng, sums);
    if (hit->quad < 0) {
      history_.escape(walk, sums);
      return false;
    }
    if (walk.photon.body >= 0) {
      switch (history_.fly(walk, hit->distance, rng, sums)) {
        case PhotonHistory::Flight::kAbsorbed:
          return false;
        case PhotonHistory::Flight::kScattered:
          return true;
        case PhotonHistory::Flight::kArrived:
          break;
      }
    } else if (in_plate != nullptr) {
      const int side = plates_[walk.band]->side_of(hit->quad);
      if (side >= 0) return in_plate->enter(walk, *hit, side, progress, rng, sums);
    }
    return history_.interact(walk, *hit, rng, sums);
  }

  const Scene& scene_;
  const PlanarScene& layout_;
  PhotonHistory history_;
  Cells cells_;
  std::vector<std::optional<PlanarPlate>> plates_;  ///< of each band
  std::vector<PlanarLayers> layers_;                ///< likewise
};

using PlanarHistory = BasicPlanarHistory<>;
extern template class BasicPlanarHistory<MeridianLight, NoArrivalObserver>;
using DotPlanarHistory = BasicPlanarHistory<MeridianLight, NoArrivalObserver, PlanarDots>;
extern template class BasicPlanarHistory<MeridianLight, NoArrivalObserver, PlanarDots>;

}  // namespace evenglow::tracer
