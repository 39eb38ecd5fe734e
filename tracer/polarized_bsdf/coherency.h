#pragma once

#include <array>
#include <complex>

#include <Eigen/Core>

#include "core/light/mueller.h"

namespace evenglow::tracer {

/// Hermitian coherency (Cloude) matrix of a Mueller matrix: H = 1/4 sum_ij M_ij (sigma_i x conj(sigma_j)), sigma the
/// Pauli matrices in Stokes order (Cloude, Optik 75, 1986). Trace H = M_00; M is physical if H has no negative
/// eigenvalue (Cloude, Proc. SPIE 1166, 1989).
using CoherencyMatrix = Eigen::Matrix<std::complex<double>, 4, 4>;

/// The 16 Hermitian matrices sigma_i x conj(sigma_j), index 4 i + j; their products have the trace 4 or 0.
const std::array<CoherencyMatrix, 16>& coherency_basis();

CoherencyMatrix coherency_matrix(const core::MuellerMatrix& M);

/// The inverse: M_ij = trace(H (sigma_i x conj(sigma_j))). H must be Hermitian.
core::MuellerMatrix mueller_matrix(const CoherencyMatrix& H);

}  // namespace evenglow::tracer
