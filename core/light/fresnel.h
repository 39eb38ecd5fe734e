#pragma once

#include <complex>

namespace evenglow::core {

/// What a smooth face between lossless media n1 (incident) and n2 does to light of one direction. Amplitudes are
/// those of fields along s = unit(k x n) (common to all rays) and p = s x k of each ray, so that r_p = -r_s at normal
/// incidence (Born & Wolf, Principles of Optics, 1.5.2).
struct FresnelFace {
  bool total_reflection = false;
  double cos_transmitted = 0.0;    ///< of the refracted ray; 0 in total reflection
  std::complex<double> r_s, r_p;   ///< amplitude reflection, signed; |r| = 1 with a phase in total reflection
  double t_s = 0.0, t_p = 0.0;     ///< amplitude transmission, signed; 0 in total reflection
  double transmitted_power = 0.0;  ///< factor (n2 cos t) / (n1 cos i) that turns |t|^2 into a share of the power

  double reflectance_s() const { return std::norm(r_s); }
  double reflectance_p() const { return std::norm(r_p); }
};

/// `cos_incident` in [0, 1]; `n1`, `n2` > 0.
FresnelFace fresnel(double cos_incident, double n1, double n2);

/// Power reflectance of natural light at a lossless parallel plate of index `n` in air, all orders of reflection
/// added without interference: 2 R / (1 + R) for s and for p apart, then averaged.
double slab_reflectance_natural(double cos_incident, double n);

}  // namespace evenglow::core
