#pragma once

#include <Eigen/Core>

#include "core/light/stokes.h"

namespace evenglow::core {

/// 4 x 4 Mueller matrix from the frame of the incident light to that of the outgoing light. Dimensionless, or 1/sr
/// in a BSDF. The frames are those of the maker; `apply` asks for both.
using MuellerMatrix = Eigen::Matrix4d;

/// s_out = M s_in. `in_e1`: first axis of the input frame of M; `out`: output frame of M.
StokesVector apply(const MuellerMatrix& M, const StokesVector& s, const Vec3& in_e1, const PolarizationFrame& out);

/// Rotation of the axes by `angle` (rad), from e1 towards e2: R = [[1,0,0,0],[0,c,s,0],[0,-s,c,0],[0,0,0,1]] with
/// c = cos 2a, s = sin 2a (Goldstein, Polarized Light, eq. 5-51).
MuellerMatrix rotator(double angle);

/// Diattenuator with power transmittances `t1` along e1 and `t2` along e2. `kappa` in [0, 1] scales rows 3 and 4:
/// 1 for a pure diattenuator, less for scatter that also depolarizes.
MuellerMatrix diattenuator(double t1, double t2, double kappa = 1.0);

/// Linear retarder: E2 lags E1 by `retardance` (rad), fast axis along e1: with exp(-i w t), E2 -> E2 exp(+i
/// retardance).
MuellerMatrix retarder(double retardance);

/// diag(1, 1-d, 1-d, 1-d): depolarizes the share `d` in [0, 1].
MuellerMatrix depolarizer(double d);

/// Least eigenvalue of the Hermitian coherency (Cloude) matrix of M, divided by its trace M_00 (0 for M = 0).
/// A physical Mueller matrix has none below zero (Cloude 1989); round-off gives about -1e-16.
double least_coherency_eigenvalue(const MuellerMatrix& M);

/// Is M physical within `tolerance` (relative to M_00)?
bool is_physical(const MuellerMatrix& M, double tolerance = 1e-9);

}  // namespace evenglow::core
