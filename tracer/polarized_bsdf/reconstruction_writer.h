#pragma once

#include <string>

#include "tracer/polarized_bsdf/reconstruction.h"

namespace evenglow::tracer {

/// The texts of the files that hold a reconstruction (docs/films.md); values with 12 digits, errors with 4.

/// The table, as `BsdfTable` reads it. Columns `tau_min_se,tau_max_se,delta_se_deg` only where errors are known,
/// `kappa` only for general readings.
std::string table_text(const Reconstruction& reconstruction);

/// The whole matrices of general readings: the node, m00 ... m33, m00_se ... m33_se,
/// `chi_square,degrees_of_freedom,chi_square_increase,least_eigenvalue,least_eigenvalue_se,rest`.
std::string mueller_text(const Reconstruction& reconstruction);

/// Upper triangles of their covariance matrices: the node, c_00_00, c_00_01 ... c_33_33.
std::string covariance_text(const Reconstruction& reconstruction);

}  // namespace evenglow::tracer
