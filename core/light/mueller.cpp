#include "core/light/mueller.h"

#include <cmath>
#include <complex>

#include <Eigen/Eigenvalues>

namespace evenglow::core {

StokesVector apply(const MuellerMatrix& M, const StokesVector& s, const Vec3& in_e1, const PolarizationFrame& out) {
  const StokesVector a = s.in_frame(in_e1);
  const Eigen::Vector4d r = M * Eigen::Vector4d(a.I, a.Q, a.U, a.V);
  return {r[0], r[1], r[2], r[3], out};
}

MuellerMatrix rotator(double angle) {
  const double c = std::cos(2.0 * angle);
  const double s = std::sin(2.0 * angle);
  MuellerMatrix M = MuellerMatrix::Identity();
  M(1, 1) = c;
  M(1, 2) = s;
  M(2, 1) = -s;
  M(2, 2) = c;
  return M;
}

MuellerMatrix diattenuator(double t1, double t2, double kappa) {
  const double sum = 0.5 * (t1 + t2);
  const double difference = 0.5 * (t1 - t2);
  const double cross = kappa * std::sqrt(t1 * t2);
  MuellerMatrix M = MuellerMatrix::Zero();
  M(0, 0) = M(1, 1) = sum;
  M(0, 1) = M(1, 0) = difference;
  M(2, 2) = M(3, 3) = cross;
  return M;
}

MuellerMatrix retarder(double retardance) {
  // U + iV = 2 E1 conj(E2) -> (U + iV) exp(-i retardance).
  const double c = std::cos(retardance);
  const double s = std::sin(retardance);
  MuellerMatrix M = MuellerMatrix::Identity();
  M(2, 2) = c;
  M(2, 3) = s;
  M(3, 2) = -s;
  M(3, 3) = c;
  return M;
}

MuellerMatrix depolarizer(double d) {
  MuellerMatrix M = MuellerMatrix::Identity();
  M(1, 1) = M(2, 2) = M(3, 3) = 1.0 - d;
  return M;
}

double least_coherency_eigenvalue(const MuellerMatrix& M) {
  if (M(0, 0) == 0.0 && M.isZero(0.0)) return 0.0;
  // H = 1/4 sum_ij M_ij (sigma_i x conj(sigma_j)), sigma the Pauli matrices in Stokes order (Cloude, Optik 75, 1986).
  using Complex = std::complex<double>;
  using Matrix2 = Eigen::Matrix<Complex, 2, 2>;
  using Matrix4 = Eigen::Matrix<Complex, 4, 4>;
  const Complex i(0.0, 1.0);
  Matrix2 sigma[4];
  sigma[0] << 1, 0, 0, 1;
  sigma[1] << 1, 0, 0, -1;
  sigma[2] << 0, 1, 1, 0;
  sigma[3] << 0, -i, i, 0;
  Matrix4 H = Matrix4::Zero();
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      const Matrix2 right = sigma[b].conjugate();
      for (Eigen::Index r = 0; r < 2; ++r) {
        for (Eigen::Index c = 0; c < 2; ++c) H.block<2, 2>(2 * r, 2 * c) += 0.25 * M(a, b) * sigma[a](r, c) * right;
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix4> solver(H, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] / std::abs(M(0, 0));
}

bool is_physical(const MuellerMatrix& M, double tolerance) {
  if (!M.allFinite() || M(0, 0) < 0.0) return false;
  if (M(0, 0) == 0.0) return M.isZero(tolerance);
  return least_coherency_eigenvalue(M) >= -tolerance;
}

}  // namespace evenglow::core
