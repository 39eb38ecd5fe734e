#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tracer/polarized_bsdf/bsdf_table.h"

namespace evenglow::tracer {

/// BSDF of natural light, measured or from a supplier, as a table that the tracer samples: CSV columns
/// `incidence_deg` [0, 90), `theta_deg` [0, 180), optionally `phi_deg` [0, 180], and `brdf`, `btdf` (1/sr; one of the
/// two may be left out). theta and phi count from the unscattered ray, mirrored for `brdf` and straight for `btdf`
/// (docs/conventions.md, "Angles of film tables"): phi 0 leads away from the normal in the plane of incidence. What
/// lies beyond 180 degrees is the mirror image; without `phi_deg` the lobe is the same all around its ray. Any order,
/// every node of the grid once; phi in at most 361 steps of at least 0.01 degrees.
///
/// The result holds for 550 nm and has tau_min = tau_max, so each polarization of the light is scattered alike.
/// Throws `core::ConfigError`: all that `core::CsvNumbers` refuses, neither or no positive value, a repeated row, a
/// missing node.
BsdfTable read_scatter_table(const std::filesystem::path& file);
BsdfTable parse_scatter_table(std::string_view text, std::string name);

}  // namespace evenglow::tracer
