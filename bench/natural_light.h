#pragma once

#include <cstdint>

#include "tracer/transport/planar_light.h"

namespace evenglow::bench {

/// Stands for `tracer::MeridianLight` in a planar walk that knows no polarization: what the walk saves by it is the
/// cost of polarization in the plate.
struct NaturalLight {
  double kx = 0.0, ky = 0.0, kz = 1.0;
  static constexpr double I = 1.0;

  NaturalLight() = default;
  explicit NaturalLight(const core::StokesVector& light)
      : kx(light.frame.k.x()), ky(light.frame.k.y()), kz(light.frame.k.z()) {}

  /// The first axis is of no account: nobody turns unpolarized light.
  core::StokesVector stokes() const { return stokes_in({core::Vec3(kx, ky, kz), core::Vec3::UnitX()}); }
  core::StokesVector stokes_in(const core::PolarizationFrame& frame) const { return {1.0, 0.0, 0.0, 0.0, frame}; }
  tracer::MeridianLight meridian() const { return tracer::MeridianLight(stokes()); }
  void count_along(const core::Vec3&, const core::StokesVector&) {}
  static constexpr bool is_polarized() { return false; }
  void forget_polarization() {}
  void turn_phase(double, double) {}
  void turn_frame(double, double) {}
  void depolarize(double) {}
  void mirror() {}
  bool scales_amplitudes(double p, double s, double whole, double uniform) const {
    return uniform * 2.0 * whole < p * p + s * s;
  }
  void scale_amplitudes(double, double) {}
  void reflect_totally(double, double, std::int64_t) {}
};

}  // namespace evenglow::bench
