#pragma once

#include <Eigen/Core>

#include "tracer/polarized_bsdf/coherency.h"

namespace evenglow::tracer {

/// The coherency matrix without negative eigenvalue whose Mueller matrix m (16 entries, row-major) minimizes
/// |root (m - m(best))|^2. `root`: a square root of the information matrix A^T W A, any units. See `fit_mueller`.
CoherencyMatrix fit_physical(const CoherencyMatrix& best, const Eigen::Matrix<double, 16, 16>& root);

}  // namespace evenglow::tracer
