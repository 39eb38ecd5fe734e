#include "core/light/fresnel.h"

#include <cmath>

namespace evenglow::core {

namespace {

/// (a - i b) / (a + i b) for real a, b, not both 0.
std::complex<double> phase_of(double a, double b) {
  const double scale = 1.0 / (a * a + b * b);
  return {(a * a - b * b) * scale, -2.0 * a * b * scale};
}

}  // namespace

FresnelFace fresnel(double cos_incident, double n1, double n2) {
  FresnelFace face;
  const double ratio = n1 / n2;
  const double sin2_transmitted = ratio * ratio * (1.0 - cos_incident * cos_incident);
  if (sin2_transmitted >= 1.0) {
    // cos t = +i g: with exp(-i w t) the field beyond the face decays.
    const double g = std::sqrt(sin2_transmitted - 1.0);
    face.total_reflection = true;
    face.r_s = phase_of(n1 * cos_incident, n2 * g);
    face.r_p = phase_of(n2 * cos_incident, n1 * g);
    return face;
  }
  const double cos_t = std::sqrt(1.0 - sin2_transmitted);
  face.cos_transmitted = cos_t;
  if (cos_incident <= 0.0) {  // grazing: all is reflected, and 0/0 is kept away
    face.r_s = -1.0;
    face.r_p = -1.0;
    return face;
  }
  const double per_s_sum = 1.0 / (n1 * cos_incident + n2 * cos_t);
  const double per_p_sum = 1.0 / (n2 * cos_incident + n1 * cos_t);
  face.r_s = (n1 * cos_incident - n2 * cos_t) * per_s_sum;
  face.r_p = (n2 * cos_incident - n1 * cos_t) * per_p_sum;
  face.t_s = 2.0 * n1 * cos_incident * per_s_sum;
  face.t_p = 2.0 * n1 * cos_incident * per_p_sum;
  face.transmitted_power = (n2 * cos_t) / (n1 * cos_incident);
  return face;
}

double slab_reflectance_natural(double cos_incident, double n) {
  const FresnelFace face = fresnel(cos_incident, 1.0, n);
  const auto plate = [](double R) { return 2.0 * R / (1.0 + R); };
  return 0.5 * (plate(face.reflectance_s()) + plate(face.reflectance_p()));
}

}  // namespace evenglow::core
