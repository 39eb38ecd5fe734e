#pragma once

#include "core/math/vec3.h"

/// Colors from tristimulus values (X, Y, Z) of the CIE 1931 observer, in any common unit.
namespace evenglow::core {

/// x = X / (X + Y + Z), y likewise. Zero for no light.
Vec2 chromaticity_xy(const Vec3& xyz);

/// CIE 1976: u' = 4 X / (X + 15 Y + 3 Z), v' = 9 Y / (X + 15 Y + 3 Z). Zero for no light.
Vec2 chromaticity_uv(const Vec3& xyz);

/// Tristimulus values of a black body (Planck, c2 = 1.4388e-2 m K) at `temperature` (K), Y = 1.
Vec3 black_body(double temperature);

/// Correlated color temperature.
struct ColorTemperature {
  double kelvin = 0.0;
  double distance = 0.0;  ///< from the Planckian locus in CIE 1960 (u, v = 2/3 v'), > 0 above it (greenish)
};

/// The temperature of the black body that is nearest in CIE 1960 (u, v) (CIE 015:2018, section 9.5), searched between
/// 1000 and 40,000 K; meaningful up to |distance| = 0.05. Zero for no light.
ColorTemperature color_temperature(const Vec3& xyz);

}  // namespace evenglow::core
