#pragma once

#include <cmath>

#include "core/base/units.h"
#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/transport/planar_plate.h"

/// Light and a plate for what the planar path does at the plate's faces.
namespace evenglow::tests {

/// 4 x 3 x 2 mm in air, nothing around it.
inline tracer::PlanarPlate bare_plate(double refractive_index) {
  tracer::PlanarPlate plate;
  plate.box.max = core::Vec3(4.0, 3.0, 2.0);
  for (std::size_t side = 0; side < tracer::kSides; ++side) {
    plate.planes[side] = plate.box.plane(static_cast<tracer::Side>(side));
    plate.quads[side] = static_cast<int>(side);
  }
  plate.refractive_index = refractive_index;
  plate.per_index = 1.0 / refractive_index;
  plate.height = 2.0;
  plate.per_height = 0.5;
  return plate;
}

/// All directions alike.
inline core::Vec3 random_direction(core::PhotonRng& rng) {
  const double z = 2.0 * rng.uniform() - 1.0;
  const double azimuth = 2.0 * core::kPi * rng.uniform();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

/// Elliptically polarized light that goes along k, its axis at random.
inline core::StokesVector polarized_light(const core::Vec3& k, core::PhotonRng& rng) {
  auto light = core::StokesVector::linear(1.0, 2.0 * core::kPi * rng.uniform(), core::PolarizationFrame::any(k));
  light.Q *= 0.8;
  light.U *= 0.8;
  light.V = 0.6;
  return light;
}

}  // namespace evenglow::tests
