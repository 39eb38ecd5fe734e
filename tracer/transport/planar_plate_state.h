#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tracer/optics/photon.h"
#include "tracer/transport/planar_light.h"
#include "tracer/transport/planar_plate.h"

namespace evenglow::tracer {

/// How far a photon has come, in and outside the plate.
struct PlanarProgress {
  double missed = 1.0;  ///< odds to have missed the pattern since it was met last
  double fate = 1.0;    ///< uniform number: the pattern is met where `missed` falls below it
  double owed = -std::numeric_limits<double>::infinity();  ///< estimates of the pattern that `NextEvent` is due
  std::int64_t events = 0;

  /// The pattern has been met, or may be for the first time.
  void begin_pattern(core::PhotonRng& rng) {
    missed = 1.0;
    fate = rng.uniform();
  }
  /// An arrival where the share `open` of the face is bare: is the pattern met? The odds are those of the density, and
  /// no random number is drawn on the way: P(met now) = P(missed < fate <= missed before) = missed before (1 - open).
  bool meets(double open, core::PhotonRng& rng) {
    missed *= open;
    if (missed >= fate) return false;
    begin_pattern(rng);
    return true;
  }
  /// An arrival for which so many estimates (at most 1) are due on average: is one due now?
  bool owes(double estimates) {
    owed += estimates;
    if (owed < 1.0) return false;
    owed -= 1.0;
    return true;
  }
};

/// Place and light of a photon in the plate, with what depends on the angles of its direction alone.
template <typename Light>
struct PlanarPlateState {
  explicit PlanarPlateState(const PlanarPlate& the_plate) : plate(the_plate) {}

  const PlanarPlate& plate;
  Light light;
  double x = 0.0, y = 0.0, z = 0.0;
  double way_x = 0.0, way_y = 0.0, way_z = 0.0;  ///< mm of path for one mm along an axis
  bool guided = false;                           ///< is it reflected totally at bottom and top?

  void load(const Photon& photon) {
    light = Light(photon.light);
    x = photon.position.x();
    y = photon.position.y();
    z = photon.position.z();
    turned();
  }
  core::Vec3 position() const { return {x, y, z}; }
  double plane(int side) const { return plate.planes[static_cast<std::size_t>(side)]; }

  /// To be called when the angles of the direction have changed.
  [[gnu::always_inline]] void turned() {
    // Along a face: so long a way that another face comes first.
    const auto way = [](double k) { return std::min(1.0 / std::abs(k), 1e200); };
    way_x = way(light.kx);
    way_y = way(light.ky);
    way_z = way(light.kz);
    guided = PlateFresnel::is_total(light.kz, plate.refractive_index);
  }
  /// What bottom and top do to light from inside.
  [[gnu::always_inline]] PlateFresnel face() const { return {std::abs(light.kz), plate.refractive_index}; }

  /// Light of these angles after so many total reflections at bottom and top.
  [[gnu::always_inline]] void reflect_totally(Light& changed, std::int64_t count) const {
    if (count == 0 || !changed.is_polarized()) return;
    const PlateFresnel total = face();
    changed.reflect_totally(total.phase_re, total.phase_im, count);
  }

  void clamp_into_plate() {
    x = std::clamp(x, plate.box.min.x(), plate.box.max.x());
    y = std::clamp(y, plate.box.min.y(), plate.box.max.y());
  }

  /// The photon in air at a quad; `counted`: the light with its frame.
  void leave(Photon& photon, int quad, const core::StokesVector& counted) const {
    photon.light = counted;
    photon.position = position();
    photon.quad = quad;
    photon.body = -1;
  }
};

/// s = k x normal of a wall x or y = const, unit.
inline core::Vec3 across_wall(const core::Vec3& k, bool x_wall) {
  const core::Vec3 cross = x_wall ? core::Vec3(0.0, k.z(), -k.y()) : core::Vec3(-k.z(), 0.0, k.x());
  const double norm2 = cross.squaredNorm();
  if (norm2 > 1e-18) return cross / std::sqrt(norm2);
  return x_wall ? core::Vec3::UnitY() : core::Vec3::UnitX();
}

}  // namespace evenglow::tracer
