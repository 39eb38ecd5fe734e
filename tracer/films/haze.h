#pragma once

#include <optional>

#include "core/base/units.h"

namespace evenglow::tracer {

/// Haze as ASTM D1003 defines it: the share of the transmitted light that deviates from the incident beam by more than
/// 2.5 degrees, at normal incidence. It is the definition, not the hazemeter: the instrument takes out what its light
/// trap sees and has a beam of some width.
inline constexpr double kHazeAngle = 2.5 * core::kRadPerDeg;

/// Haze of a diffuser all of whose transmitted light is scattered by a Gaussian lobe (`SymmetricLobe`) of this full
/// width at half maximum (rad, in [1, 150] degrees).
double gaussian_haze(double fwhm);

/// The width (rad) whose haze this is; empty if no width in [1, 150] degrees has it.
std::optional<double> fwhm_of_haze(double haze);

}  // namespace evenglow::tracer
