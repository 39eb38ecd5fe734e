#pragma once

#include <span>

#include <Eigen/Core>

#include "core/light/mueller.h"
#include "tracer/polarized_bsdf/diattenuator_fit.h"

namespace evenglow::tracer {

/// Reading behind polarizers in both channels: value = out . M in.
struct MuellerReading {
  Eigen::Vector4d in = Eigen::Vector4d::UnitX();   ///< Stokes vector of the illumination, illuminance 1
  Eigen::Vector4d out = Eigen::Vector4d::UnitX();  ///< what the analyzer multiplies with (polarizer.h)
  double value = 0.0;                              ///< 1/sr
  double se = 1.0;                                 ///< standard error, 1/sr, > 0
};

/// Entries in row-major order: M_ij has the index 4 i + j.
using MuellerCovariance = Eigen::Matrix<double, 16, 16>;

/// What a set of readings can tell: states of polarization that are linearly independent.
struct ReadingRank {
  int all = 0;           ///< of the 16 entries, how many combinations are determined
  int illumination = 0;  ///< of 4
  int observation = 0;   ///< of 4
};

/// Weighted least squares for the 16 entries of a Mueller matrix.
struct MuellerFit {
  core::MuellerMatrix M;              ///< the best physical matrix
  core::MuellerMatrix unconstrained;  ///< the best matrix
  /// Of M. Where the constraint does not act, (A^T W A)^-1; where it does, the same within the physical matrices of the
  /// rank found (tangent space of that face of the cone): the directions that the constraint has settled have no error.
  MuellerCovariance covariance;
  double chi_square = 0.0;           ///< of the best matrix
  int degrees_of_freedom = 0;        ///< readings less 16
  double chi_square_increase = 0.0;  ///< what a physical matrix costs; noise alone: at most a chi-square of 9
  double least_eigenvalue = 0.0;     ///< of the coherency matrix of `unconstrained`, 1/sr
  double least_eigenvalue_se = 0.0;  ///< of first order
  bool constrained = false;          ///< the best matrix is not physical, M is another one
};

ReadingRank reading_rank(std::span<const MuellerReading> readings);

/// The readings must determine all 16 entries (`reading_rank(...).all == 16`; a promise: throws `core::Error`).
///
/// Where the best matrix has a coherency matrix H with a negative eigenvalue, H = L L^dagger with a lower triangular L
/// (16 real numbers) is fitted by BFGS (Ceres), from the best matrix with its eigenvalues raised to a
/// small positive number. The problem is convex in H, and L of full size has no further local minimum
/// (Burer & Monteiro, Math. Program. 103, 2005). Throws `core::Error` if the solver fails.
MuellerFit fit_mueller(std::span<const MuellerReading> readings);

/// What a table can hold of a Mueller matrix M = R(-d_o) D(tau_min, tau_max, kappa) R(d_i) (docs/films.md).
struct TableForm {
  FirstRow row;        ///< S = 2 M00, X = -2 M01, Y = -2 M02 with their covariance
  double kappa = 1.0;  ///< (M33 + det m / M00) / 2 over sqrt(tau_min tau_max), m = entries 1, 2; within [0, 1]
  double rest = 0.0;   ///< |M - the matrix of this form| / |M| (Frobenius): what the table leaves out
};
TableForm table_form(const core::MuellerMatrix& M, const MuellerCovariance& covariance);

}  // namespace evenglow::tracer
