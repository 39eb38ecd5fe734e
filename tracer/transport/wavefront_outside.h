#pragma once

#include <array>

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
                   const PlanarPlate& plate, const PlanarCells& cells);

  /// A photon as its source emits it. Where it comes straight to a smooth wall of the plate, as that of most sources
  /// does, `side` is the wall, and `state` tells of the ray in air there; else it is followed, and `side` is -1.
  /// False: it has ended. Else it is in the plate, as `state` and `progress` tell, or at that wall.
  bool start(Walk& walk, int& side, core::PhotonRng& rng, BatchSums& sums);
  /// A photon that has left the kernel through the top, above which there is nothing.
  void escape(const core::Vec3& position, const core::Vec3& k, std::int64_t events, Walk& walk, BatchSums& sums) const;
  /// A photon that was absorbed in the kernel's hands.
  void absorb(int part, std::int64_t events, const Walk& walk, BatchSums& sums) const {
    sums.energy[scene_.energy.absorbed_bin(part)] += walk.weight.y();
    sums.events[0] += static_cast<double>(events);
  }
  /// A photon that has left the kernel at `exit`, neither absorbed nor escaped; its place and light are those of
  /// `state`, not of the walk.
  bool go_on(LaneExit exit, int side, Walk& walk, core::PhotonRng& rng, BatchSums& sums);

  PlanarPlateState<MeridianLight>& state() { return state_; }
  PlanarProgress& progress() { return progress_; }

 private:
  /// How far from the wall of a side a source may be for nothing to be between, mm.
  double clear_before(Side side) const;
  /// The smooth wall that a photon from a source meets first, -1: unknown. Then its place is the state's.
  int wall_ahead(const Photon& photon);
  Place leave(LaneExit exit, int side, Walk& walk, core::PhotonRng& rng, BatchSums& sums);
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
  int quad_below_;                 ///< of the sheet below the plate
  std::array<double, 4> clear_{};  ///< `clear_before` of each wall
  PlanarPlateState<MeridianLight> state_;
  PlanarProgress progress_;
};

}  // namespace evenglow::tracer
