#pragma once

#include <functional>

#include "core/config/config_node.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {

/// Reads the material of a plate: index and bulk absorption at any wavelength (nm) from 380 to 780. One of `material`,
/// `refractive_index` and `dispersion`.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | material | pmma or polycarbonate (tracer/optics/material.h) | pmma |
/// | refractive_index | the same at every wavelength | none |
/// | dispersion | map: kind `sellmeier` (b, c_um2: n^2 = 1 + sum b l^2 / (l^2 - c)), `cauchy` (a, b_um2, c_um4: n = a +
/// b / l^2 + c / l^4), both with l in um, or `table` (file: CSV wavelength_nm,refractive_index, linear between the rows
/// and held beyond them) | none |
/// | absorption_per_m | bulk absorption, 1/m | that of the material, else 0 |
/// | absorption_file | instead: CSV wavelength_nm,absorption_per_m, linear between the rows and held beyond | none |
std::function<Material(double)> read_material(const core::ConfigNode& node);

}  // namespace evenglow::tracer
