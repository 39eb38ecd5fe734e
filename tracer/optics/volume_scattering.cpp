#include "tracer/optics/volume_scattering.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace evenglow::tracer {

using core::Vec3;

double henyey_greenstein_cosine(double g, double uniform) {
  if (std::abs(g) < 1e-4) return 2.0 * uniform - 1.0 + 1.5 * g * (1.0 - std::pow(2.0 * uniform - 1.0, 2));
  const double ratio = (1.0 - g * g) / (1.0 - g + 2.0 * g * uniform);
  return std::clamp((1.0 + g * g - ratio * ratio) / (2.0 * g), -1.0, 1.0);
}

double VolumeScattering::free_path(core::PhotonRng& rng) const {
  return -std::log(rng.uniform()) / coefficient;
}

core::StokesVector VolumeScattering::scatter(const core::StokesVector& light, core::PhotonRng& rng) const {
  const double cosine = henyey_greenstein_cosine(anisotropy, rng.uniform());
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double azimuth = 2.0 * core::kPi * rng.uniform();
  const Vec3& k = light.frame.k;
  const Vec3& e1 = light.frame.e1;
  // Across k, towards which the ray turns; the field turns in the plane of k and `towards` with the ray.
  const Vec3 towards = std::cos(azimuth) * e1 + std::sin(azimuth) * k.cross(e1);
  const Vec3 new_k = cosine * k + sine * towards;
  const double along = e1.dot(towards);
  const Vec3 new_e1 = e1 + along * ((cosine - 1.0) * towards - sine * k);
  const double kept = 1.0 - depolarization;
  return {light.I, kept * light.Q, kept * light.U, kept * light.V, {new_k, new_e1}};
}

}  // namespace evenglow::tracer
