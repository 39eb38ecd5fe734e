#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/batch_sums.h"
#include "tracer/transport/next_event.h"
#include "tracer/transport/pattern_dots.h"

namespace evenglow::tracer {

/// One photon from birth to absorption or escape, in any scene: the reference that faster paths are held against.
class PhotonHistory {
 public:
  PhotonHistory(const Scene& scene, const DensityField& density);

  /// Traces the photon with this index and adds what it does to `sums`.
  void run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums) const;

  /// A photon between two events.
  struct Walk {
    Photon photon;
    double optical_depth = 0.0;    ///< left until bulk absorption
    int events = 0;                ///< survived so far
    int corner = -1;               ///< the quad met before the photon's last, if both were met at one point; else -1
    NextEvent::Coverage coverage;  ///< is its way to the viewer estimated?
    NextEvent::PatternTold told = NextEvent::PatternTold::kMet;
    std::size_t band = 0;                    ///< its wavelength
    core::Vec3 weight = core::Vec3::Ones();  ///< X, Y, Z that it carries (`SpectralBands::Choice`)
  };
  /// A photon as it leaves its source.
  Walk start(core::PhotonRng& rng) const;
  /// One flight and one interaction, added to `sums`; false: the history has ended.
  bool step(Walk& walk, core::PhotonRng& rng, BatchSums& sums) const;

  // What a step is made of, for paths that find the next hit in a way of their own.

  /// The optics that a photon meets at a point of a surface.
  struct Encounter {
    const Bsdf* optics = nullptr;
    int part = 0;
  };
  enum class Flight { kArrived, kScattered, kAbsorbed };
  /// The way through the bulk to a surface at `distance`: the photon may be absorbed or scattered on it.
  Flight fly(Walk& walk, double distance, core::PhotonRng& rng, BatchSums& sums) const;
  /// What the surface that was hit does to the photon; false: the history has ended.
  bool interact(Walk& walk, const RayHit& hit, core::PhotonRng& rng, BatchSums& sums) const;
  /// The same where what is met there is known already.
  bool interact(Walk& walk, const RayHit& hit, const Encounter& encounter, core::PhotonRng& rng, BatchSums& sums) const;
  /// Adds a photon that meets nothing more.
  void escape(const Walk& walk, BatchSums& sums) const { escape_by(exit_side(walk), walk, sums); }
  /// The same where the side that it leaves by is known.
  void escape_by(Side side, const Walk& walk, BatchSums& sums) const;
  /// The same where it is known how it leaves the backlight.
  void escape(const Walk& walk, const Crossing& crossing, BatchSums& sums) const;
  const NextEvent& next_event() const { return next_event_; }

  /// More events than this end a history as stuck.
  static constexpr int kMaxEvents = 1000000;

 private:
  Side exit_side(const Walk& walk) const {
    return scene_.box.exit_side(walk.photon.position, walk.photon.light.frame.k);
  }
  Walk emit(core::PhotonRng& rng) const;
  /// Does the photon scatter in the bulk of its body within `distance`? Then it is turned there.
  bool scatters_within(Walk& walk, const Body& body, double distance, core::PhotonRng& rng) const;
  /// Nearest surface: of the few faces of the body that the photon is in, else by the ray caster. A hit of the latter
  /// that contradicts where the photon is, is searched for anew in double precision; so is one that leads back and
  /// forth in a corner, where a point lies on both quads and a ray away from one seems to meet it.
  RayHit next_hit(const Walk& walk) const;
  /// Can the photon meet this quad next? Bodies are convex: from inside only their own faces can be met, from the
  /// inside; from a face outwards, none of the same body.
  bool can_meet(const Photon& photon, int quad) const;
  bool consistent(const Photon& photon, const RayHit& hit) const;
  Encounter meet(const Surface& surface, const Walk& walk, const core::Vec3& position, core::PhotonRng& rng) const;
  /// What the optics make of the light (frame of the surface), and where it leaves the face (`position`).
  std::optional<BsdfSample> sample(const Surface& surface, const Walk& walk, const Encounter& encounter,
                                   const core::StokesVector& light, core::Vec3& position, core::PhotonRng& rng) const;

  const Scene& scene_;
  const std::vector<Surface>& quads_;  ///< surfaces of the first wavelength: where they lie is the same for all
  const DensityField& density_;
  PatternDots dots_;
  NextEvent next_event_;
  std::vector<std::vector<int>> faces_;  ///< of each body: its quads
  std::vector<core::Vec3> outward_;  ///< of each quad: the normal out of the box where it lies in its border, else 0
};

}  // namespace evenglow::tracer
