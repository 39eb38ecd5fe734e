#pragma once

#include <cstdint>

#include "core/math/lambertian.h"
#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_plate_state.h"
#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {

/// A photon that comes to the patterned face, from inside or outside.
struct PatternArrival {
  std::size_t cell = 0;
  bool met = false;  ///< the microstructure, else the smooth face
  core::Vec3 position = core::Vec3::Zero();
  MeridianLight light{};
};

/// Is told nothing; costs nothing. Another observer has `kActive` = true and is called with each PatternArrival, or, if
/// it has `arrive(cell, met)`, with these two alone.
struct NoArrivalObserver {
  static constexpr bool kActive = false;
  void operator()(const PatternArrival&) const {}
};

/// What befalls light at the patterned face of the plate: whether it meets the pattern, what plain dots make of it, and
/// the estimates that `NextEvent` is due there. `Cells`: of `PlanarCells` or `PlanarDots`, for one wavelength.
template <typename Light, typename Observer, typename Cells>
class PlanarPattern {
 public:
  using Walk = PhotonHistory::Walk;

  /// `state`: of the walk, which this one changes where a dot turns the light.
  PlanarPattern(PlanarPlateState<Light>& state, const Cells& cells, const PhotonHistory& history, const Scene& scene,
                Observer& observer)
      : plate_(state.plate),
        cells_(cells),
        history_(history),
        scene_(scene),
        observer_(observer),
        s_(state),
        estimates_(history.next_event().active()) {}

  /// At the place of the state: is the pattern met?
  bool meets(PlanarProgress& progress, core::PhotonRng& rng) { return meets_at(cell_here(), progress, rng); }

  /// The same for light from inside, with the estimate that may be due.
  bool meets_from_inside(const Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    const std::size_t cell = cell_here();
    if (estimates_ && progress.owes(NextEvent::estimates(cells_.depth(cell)))) estimate(walk, 0, 0.0, sums);
    return meets_at(cell, progress, rng);
  }

  /// Faces met before the pattern is: every second arrival from `first` on comes to the patterned face.
  [[gnu::always_inline]] std::int64_t first_meeting(std::int64_t faces, std::int64_t first, double to_face,
                                                    double period, const Walk& walk, PlanarProgress& progress,
                                                    core::PhotonRng& rng, BatchSums& sums) {
    const double start = to_face + static_cast<double>(first) * period;
    double column = cells_.column(s_.x + s_.light.kx * start);
    double row = cells_.row(s_.y + s_.light.ky * start);
    const double columns = cells_.columns_per(2.0 * s_.light.kx * period);
    const double rows = cells_.rows_per(2.0 * s_.light.ky * period);
    if (!Observer::kActive && !estimates_) {  // nobody to tell: the odds stay in a register
      double missed = progress.missed;
      const double fate = progress.fate;
      for (std::int64_t face = first; face < faces; face += 2) {
        missed *= cells_.open(cells_.cell_inside(column, row, s_.light));
        if (missed < fate) {
          progress.begin_pattern(rng);
          return face;
        }
        column += columns;
        row += rows;
      }
      progress.missed = missed;
      return faces;
    }
    for (std::int64_t face = first; face < faces; face += 2) {
      const std::size_t cell = cells_.cell_inside(column, row, s_.light);
      const bool met = progress.meets(cells_.open(cell), rng);
      if (estimates_ && progress.owes(NextEvent::estimates(cells_.depth(cell)))) {
        estimate(walk, face, to_face + static_cast<double>(face) * period, sums);
      }
      if constexpr (Observer::kActive) tell(cell, met, face, to_face + static_cast<double>(face) * period);
      if (met) return face;
      column += columns;
      row += rows;
    }
    return faces;
  }

  /// A plain dot from inside; false: absorbed.
  [[gnu::always_inline]] bool meet_dot(Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
    const PlainReflector& dots = plate_.dots;
    const double u = rng.uniform();
    const bool mirrored = u < dots.mirrored;
    if (estimates_) estimate_dot(walk, mirrored, sums);
    if (u >= dots.reflectance) {
      sums.energy[scene_.energy.absorbed_bin(dots.part)] += walk.weight.y();
      return false;
    }
    Light& k = s_.light;
    if (mirrored) {
      k.mirror();
      k.kz = -k.kz;
      return true;
    }
    const core::Vec3 out = core::draw_lambertian(rng, dots.again(u));
    k.forget_polarization();
    k.kx = out.x();
    k.ky = out.y();
    k.kz = std::copysign(out.z(), -k.kz);
    s_.turned();
    return true;
  }

 private:
  [[gnu::always_inline]] std::size_t cell_here() const { return cells_.cell_met(cells_.column(s_.x), cells_.row(s_.y), s_.light); }

  bool meets_at(std::size_t cell, PlanarProgress& progress, core::PhotonRng& rng) {
    const bool met = progress.meets(cells_.open(cell), rng);
    if constexpr (Observer::kActive) tell(cell, met, 0, 0.0);
    return met;
  }

  void tell(std::size_t cell, bool met, std::int64_t reflections, double distance) {
    if constexpr (requires(Observer & observer) { observer.arrive(cell, met); }) {
      observer_.arrive(cell, met);
    } else {
      tell_in_full(cell, met, reflections, distance);
    }
  }

  void tell_in_full(std::size_t cell, bool met, std::int64_t reflections, double distance) {
    Light light = s_.light;
    s_.reflect_totally(light, reflections);
    if (reflections % 2 != 0) light.kz = -light.kz;
    const double z = s_.plane(plate_.pattern_side);
    observer_(PatternArrival{cell, met, {s_.x + light.kx * distance, s_.y + light.ky * distance, z}, light.meridian()});
  }

  int quad() const { return plate_.quads[static_cast<std::size_t>(plate_.pattern_side)]; }

  /// What `NextEvent` is due at an arrival at the pattern from inside, whether or not it is met.
  [[gnu::noinline]] void estimate(const Walk& walk, std::int64_t reflections, double distance, BatchSums& sums) const {
    const core::Vec3 place(s_.x + s_.light.kx * distance, s_.y + s_.light.ky * distance, s_.plane(plate_.pattern_side));
    core::StokesVector arriving{1.0, 0.0, 0.0, 0.0, {}};
    if (!plate_.dots.known) {  // else only the side counts from which it comes (`estimate_dot`)
      Light light = s_.light;
      s_.reflect_totally(light, reflections);
      if (reflections % 2 != 0) light.kz = -light.kz;
      arriving = to_local(scene_.optics[walk.band].surfaces[static_cast<std::size_t>(quad())], light.stokes());
    }
    history_.next_event().estimate_pattern({quad(), *plate_.pattern, arriving, place, walk.band, walk.weight}, sums);
  }

  /// Of a plain dot that is met.
  [[gnu::noinline]] void estimate_dot(Walk& walk, bool mirrored, BatchSums& sums) const {
    const NextEvent& next_event = history_.next_event();
    const core::Vec3 position = s_.position();
    // Only the side counts from which the light comes: along the normal, out of the plate.
    const core::StokesVector light{1.0, 0.0, 0.0, 0.0, {}};
    const NextEvent::Meeting meeting{quad(), *plate_.pattern, light, position, walk.band, walk.weight, walk.told};
    const bool estimated = next_event.meet(walk.coverage, meeting, sums);
    next_event.leave(walk.coverage, meeting, estimated, mirrored);
  }

  const PlanarPlate& plate_;
  const Cells& cells_;
  const PhotonHistory& history_;
  const Scene& scene_;
  Observer& observer_;
  PlanarPlateState<Light>& s_;
  bool estimates_ = false;  ///< is the luminance estimated at the pattern?
};

}  // namespace evenglow::tracer
