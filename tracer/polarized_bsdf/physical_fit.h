#pragma once

#include <Eigen/Core>

#include "tracer/polarized_bsdf/coherency.h"

namespace evenglow::tracer {

/// The coherency matrix without negative eigenvalue whose Mueller matrix m (16 entries, row-major) minimizes
/// |root (m - m(best))|^2. `root`: a square root of the information matrix A^T W A, any units. See `fit_mueller`.
///
/// BFGS and not Levenberg-Marquardt: where an eigenvalue goes to zero its column of L does too, the Jacobian with it,
/// and the curvature that is left comes from the residuals, which Gauss-Newton drops; it would creep.
CoherencyMatrix fit_physical(const CoherencyMatrix& best, const Eigen::Matrix<double, 16, 16>& root);

}  // namespace evenglow::tracer
