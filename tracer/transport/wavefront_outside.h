#pragma once

#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_cells.h"
#include "tracer/transport/planar_plate.h"
#include "tracer/transport/planar_plate_state.h"
#include "tracer/transport/planar_scene.h"
#include "tracer/wavefront/plate_lanes.h"

namespace evenglow::tracer {

/// A photon of the wavefront that is not in the kernel's hands: from where it has left the plate, or from its source,
/// until it is in the plate again or ends.
class WavefrontOutside {
 public:
  using Walk = PhotonHistory::Walk;
  enum class Place { kAir, kPlate, kEnded };

  /// The arguments must outlive it.
  WavefrontOutside(const Scene& scene, const PlanarScene& layout, const PhotonHistory& history,
                   const PlanarPlate& plate, const PlanarCells& cells)
      : scene_(scene),
        layout_(layout),
        history_(history),
        plate_(plate),
        cells_(cells),
        quad_below_(layout.wall(Side::kBottom)),
        state_(plate) {}

  /// A photon as its source emits it; true: it is in the plate, as `state` and `progress` tell; false: it has ended.
  bool start(Walk& walk, core::PhotonRng& rng, BatchSums& sums);
  /// A photon that has left the kernel at `exit`; its place and light are those of `state`, not of the walk.
  bool go_on(LaneExit exit, int side, int part, Walk& walk, core::PhotonRng& rng, BatchSums& sums);

  PlanarPlateState<MeridianLight>& state() { return state_; }
  PlanarProgress& progress() { return progress_; }

 private:
  Place leave(LaneExit exit, int side, int part, Walk& walk, core::PhotonRng& rng, BatchSums& sums);
  bool follow(Place place, Walk& walk, core::PhotonRng& rng, BatchSums& sums);
  Place step(Walk& walk, core::PhotonRng& rng, BatchSums& sums);
  Place enter(Walk& walk, const RayHit& hit, int side, core::PhotonRng& rng, BatchSums& sums);
  Place interact(Walk& walk, const RayHit& hit, const PhotonHistory::Encounter& encounter, core::PhotonRng& rng,
                 BatchSums& sums);
  Place general_step(Walk& walk, core::PhotonRng& rng, BatchSums& sums);
  bool meets_pattern(core::PhotonRng& rng);
  Place where(const Walk& walk);
  /// In air at a quad behind or on the wall `side`; the state's light is counted in the wall's frame.
  void leave_by_wall(int side, int quad, Walk& walk);
  PhotonHistory::Encounter optics_of(int quad) const {
    const Surface& surface = scene_.optics.front().surfaces[static_cast<std::size_t>(quad)];
    return {surface.optics, surface.part};
  }
  int plate_quad(int side) const { return plate_.quads[static_cast<std::size_t>(side)]; }

  const Scene& scene_;
  const PlanarScene& layout_;
  const PhotonHistory& history_;
  const PlanarPlate& plate_;
  const PlanarCells& cells_;
  int quad_below_;  ///< of the sheet below the plate
  PlanarPlateState<MeridianLight> state_;
  PlanarProgress progress_;
};

}  // namespace evenglow::tracer
