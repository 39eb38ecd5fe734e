#include "tracer/polarized_bsdf/mueller_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/base/error.h"
#include "tracer/polarized_bsdf/coherency.h"
#include "tracer/polarized_bsdf/physical_fit.h"

namespace evenglow::tracer {
namespace {

using Design = Eigen::Matrix<double, Eigen::Dynamic, 16>;
using Vector16 = Eigen::Matrix<double, 16, 1>;
using Eigensystem = Eigen::SelfAdjointEigenSolver<CoherencyMatrix>;

constexpr double kRankThreshold = 1e-7;  ///< singular value over the largest
constexpr double kRounding = 1e-13;      ///< eigenvalue over the trace that is no contradiction
constexpr double kOnTheFace = 1e-5;      ///< eigenvalue over the trace that the constraint holds at zero

Vector16 row_of(const MuellerReading& reading) {
  Vector16 row;
  for (int k = 0; k < 16; ++k) row[k] = reading.out[k / 4] * reading.in[k % 4];
  return row;
}

template <typename Matrix>
int rank_of(const Matrix& matrix) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  qr.setThreshold(kRankThreshold);
  return static_cast<int>(qr.rank());
}

/// Entries of a Hermitian matrix as its Mueller matrix.
Vector16 entries_of(const CoherencyMatrix& H) {
  const core::MuellerMatrix M = mueller_matrix(H);
  Vector16 entries;
  for (int k = 0; k < 16; ++k) entries[k] = M(k / 4, k % 4);
  return entries;
}

core::MuellerMatrix matrix_of(const Vector16& entries) {
  core::MuellerMatrix M;
  for (int k = 0; k < 16; ++k) M(k / 4, k % 4) = entries[k];
  return M;
}

/// Error of the eigenvalue v^dagger H v, which is linear in M for a fixed v.
double eigenvalue_se(const Eigen::Vector4cd& v, const MuellerCovariance& covariance) {
  Vector16 gradient;
  for (int k = 0; k < 16; ++k) {
    gradient[k] = 0.25 * v.dot(coherency_basis()[static_cast<std::size_t>(k)] * v).real();
  }
  return std::sqrt(gradient.dot(covariance * gradient));
}

/// Covariance within the physical matrices of the rank of H: dH = dB B^dagger + B dB^dagger for H = B B^dagger, B of
/// 4 x rank. The parameters are redundant by a unitary factor; the pseudo-inverse takes that out.
MuellerCovariance covariance_on_face(const CoherencyMatrix& H, const MuellerCovariance& root) {
  const Eigensystem eigen(H);
  const double least = kOnTheFace * eigen.eigenvalues().sum();
  const double trace = eigen.eigenvalues().sum();
  std::vector<Vector16> tangents;
  for (int r = 0; r < 4; ++r) {
    if (eigen.eigenvalues()[r] <= least) continue;
    const Eigen::Vector4cd b = eigen.eigenvectors().col(r) * std::sqrt(eigen.eigenvalues()[r] / trace);
    for (int part = 0; part < 8; ++part) {
      Eigen::Vector4cd step = Eigen::Vector4cd::Zero();
      step[part / 2] = part % 2 == 0 ? std::complex<double>(1, 0) : std::complex<double>(0, 1);
      const CoherencyMatrix half = step * b.adjoint();
      tangents.push_back(entries_of(half + half.adjoint()));
    }
  }
  if (tangents.empty()) return MuellerCovariance::Zero();
  Eigen::MatrixXd T(16, static_cast<Eigen::Index>(tangents.size()));
  for (Eigen::Index i = 0; i < T.cols(); ++i) T.col(i) = tangents[static_cast<std::size_t>(i)];
  // An orthonormal basis of the tangent space first: its dimension is a property of the face, not of the weights.
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> basis(T);
  basis.setThreshold(kRankThreshold);
  const Eigen::MatrixXd Q = Eigen::MatrixXd(basis.householderQ()).leftCols(basis.rank());
  const Eigen::MatrixXd K = root * Q;
  const Eigen::MatrixXd information = K.transpose() * K;
  return Q * information.ldlt().solve(Q.transpose());
}

}  // namespace

ReadingRank reading_rank(std::span<const MuellerReading> readings) {
  const auto count = static_cast<Eigen::Index>(readings.size());
  Design all(count, 16);
  Eigen::Matrix<double, Eigen::Dynamic, 4> in(count, 4), out(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MuellerReading& reading = readings[static_cast<std::size_t>(i)];
    all.row(i) = row_of(reading).transpose();
    in.row(i) = reading.in.transpose();
    out.row(i) = reading.out.transpose();
  }
  return {rank_of(all), rank_of(in), rank_of(out)};
}

MuellerFit fit_mueller(std::span<const MuellerReading> readings) {
  core::expects(reading_rank(readings).all == 16, "readings determine all 16 entries");
  const auto count = static_cast<Eigen::Index>(readings.size());
  Design A(count, 16);
  Eigen::VectorXd y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const MuellerReading& reading = readings[static_cast<std::size_t>(i)];
    A.row(i) = row_of(reading).transpose() / reading.se;
    y[i] = reading.value / reading.se;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  const Vector16 best = qr.solve(y);
  const MuellerCovariance R = qr.matrixQR().topRows<16>().triangularView<Eigen::Upper>();
  const MuellerCovariance permutation = qr.colsPermutation();
  const MuellerCovariance root = R * permutation.transpose();  // chi-square = |root (m - best)|^2 + what no m can mend
  const MuellerCovariance inverse = permutation * R.triangularView<Eigen::Upper>().solve(MuellerCovariance::Identity());

  MuellerFit fit;
  fit.unconstrained = fit.M = matrix_of(best);
  fit.covariance = inverse * inverse.transpose();
  fit.chi_square = (y - A * best).squaredNorm();
  fit.degrees_of_freedom = static_cast<int>(count) - 16;
  const CoherencyMatrix H = coherency_matrix(fit.unconstrained);
  const Eigensystem eigen(H);
  fit.least_eigenvalue = eigen.eigenvalues()[0];
  fit.least_eigenvalue_se = eigenvalue_se(eigen.eigenvectors().col(0), fit.covariance);
  const double size = eigen.eigenvalues().cwiseAbs().sum();
  if (fit.least_eigenvalue >= -kRounding * size) return fit;

  fit.constrained = true;
  const CoherencyMatrix physical = fit_physical(H, root);
  fit.M = mueller_matrix(physical);
  fit.chi_square_increase = (root * (entries_of(physical) - best)).squaredNorm();
  fit.covariance = covariance_on_face(physical, root);
  return fit;
}

TableForm table_form(const core::MuellerMatrix& M, const MuellerCovariance& covariance) {
  TableForm form;
  form.row.value = {2.0 * M(0, 0), -2.0 * M(0, 1), -2.0 * M(0, 2)};
  const Eigen::Vector3d sign(2.0, -2.0, -2.0);
  form.row.covariance = sign.asDiagonal() * covariance.topLeftCorner<3, 3>() * sign.asDiagonal();
  const DiattenuatorValues values = diattenuator_values(form.row);
  const Eigen::Matrix2d m = M.block<2, 2>(1, 1);
  const double cross = std::sqrt(values.tau_min * values.tau_max);
  if (cross > 0.0 && M(0, 0) > 0.0) {
    form.kappa = std::clamp(0.5 * (M(3, 3) + m.determinant() / M(0, 0)) / cross, 0.0, 1.0);
  }
  // m = R(-d_o) diag(a, c) R(d_i): its part that is a rotation turns by d_i - d_o.
  const double turn = 0.5 * std::atan2(m(0, 1) - m(1, 0), m(0, 0) + m(1, 1));
  const core::MuellerMatrix shape = core::rotator(turn - values.delta) *
                                    core::diattenuator(values.tau_min, values.tau_max, form.kappa) *
                                    core::rotator(values.delta);
  const double norm = M.norm();
  form.rest = norm > 0.0 ? (M - shape).norm() / norm : 0.0;
  return form;
}

}  // namespace evenglow::tracer
