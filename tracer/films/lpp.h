#pragma once

#include "tracer/films/ideal_polarizer.h"

namespace evenglow::tracer {

/// Absorbing linear polarizer (iodine in stretched PVA; O-type, see pass_axis.h). Defaults: 43 % of natural light
/// passes with a degree of polarization of 99.9 %, in the middle of data sheets of such polarizers (42.5 to 44.7 %, at
/// least 99 %).
struct LppSpec {
  double k1 = 0.8596;         ///< transmittance of light along the pass axis, faces included; (k1 + k2) / 2 = 0.43
  double k2 = 0.0004;         ///< along the block axis; (k1 - k2) / (k1 + k2) = 0.9991
  double reflectance = 0.04;  ///< of any light, polarization kept; k1 + reflectance <= 1
  double axis = 0.0;          ///< rad, pass axis from +x towards +y
};

/// Refractive index of the film that holds the dye (PVA, Yeh & Gu: about 1.5).
inline constexpr double kLppIndex = 1.5;

/// The surface: specular, the same from both sides.
IdealPolarizer lpp_surface(const LppSpec& spec);

}  // namespace evenglow::tracer
