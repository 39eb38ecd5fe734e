#include "core/light/fresnel.h"

#include <cmath>

namespace evenglow::core {

FresnelFace fresnel(double cos_incident, double n1, double n2) {
  FresnelFace face;
  const double ratio = n1 / n2;
  const double sin2_transmitted = ratio * ratio * (1.0 - cos_incident * cos_incident);
  if (sin2_transmitted >= 1.0) {
    // cos t = +i g: with exp(-i w t) the field beyond the face decays.
    const std::complex<double> cos_t(0.0, std::sqrt(sin2_transmitted - 1.0));
    face.total_reflection = true;
    face.r_s = (n1 * cos_incident - n2 * cos_t) / (n1 * cos_incident + n2 * cos_t);
    face.r_p = (n2 * cos_incident - n1 * cos_t) / (n2 * cos_incident + n1 * cos_t);
    return face;
  }
  const double cos_t = std::sqrt(1.0 - sin2_transmitted);
  const double s_sum = n1 * cos_incident + n2 * cos_t;
  const double p_sum = n2 * cos_incident + n1 * cos_t;
  face.cos_transmitted = cos_t;
  if (cos_incident <= 0.0) {  // grazing: all is reflected, and 0/0 is kept away
    face.r_s = -1.0;
    face.r_p = -1.0;
    return face;
  }
  face.r_s = (n1 * cos_incident - n2 * cos_t) / s_sum;
  face.r_p = (n2 * cos_incident - n1 * cos_t) / p_sum;
  face.t_s = 2.0 * n1 * cos_incident / s_sum;
  face.t_p = 2.0 * n1 * cos_incident / p_sum;
  face.transmitted_power = (n2 * cos_t) / (n1 * cos_incident);
  return face;
}

double slab_reflectance_natural(double cos_incident, double n) {
  const FresnelFace face = fresnel(cos_incident, 1.0, n);
  const auto plate = [](double R) { return 2.0 * R / (1.0 + R); };
  return 0.5 * (plate(face.reflectance_s()) + plate(face.reflectance_p()));
}

}  // namespace evenglow::core
