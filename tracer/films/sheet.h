#pragma once

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// Longest sheet in mean free paths that a run may ask for: photons in thicker ones are traced for ever.
inline constexpr double kMostScatters = 1000.0;

/// Kind `sheet`: a dielectric sheet with two smooth faces, clear or scattering in its bulk (volume_scattering.h).
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | refractive_index | [1.0001, 4] | 1.5 |
/// | material | pmma or polycarbonate instead of an index, with dispersion and loss (material.h) | none |
/// | absorption_per_m | bulk, 1/m | 0, or of the material |
/// | thickness_mm | [0.001, 100] | 0.1 |
/// | scattering_per_mm | mean scatters per mm, [0, 10000]; times thickness_mm at most 1000 | 0: clear |
/// | anisotropy | g, [-0.99, 0.999] | 0.9 |
/// | depolarization | share of the polarization that one scatter takes, [0, 1] | 1 |
///
/// Particles scatter all wavelengths alike.
Film make_sheet(const core::ConfigNode& node);

}  // namespace evenglow::tracer
