#include "tracer/polarized_bsdf/coherency.h"

#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

core::MuellerMatrix random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  core::MuellerMatrix M;
  for (int k = 0; k < 16; ++k) M(k / 4, k % 4) = normal(random);
  return M;
}

TEST(Coherency, BasisIsOrthogonalAndHermitian) {
  const auto& basis = coherency_basis();
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_LT((basis[i] - basis[i].adjoint()).norm(), 1e-15);
    for (std::size_t j = 0; j < 16; ++j) {
      EXPECT_NEAR(std::abs((basis[i] * basis[j]).trace() - (i == j ? 4.0 : 0.0)), 0.0, 1e-14) << i << " " << j;
    }
  }
}

TEST(Coherency, ThereAndBackIsNothing) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const core::MuellerMatrix M = random_matrix(random);
    const CoherencyMatrix H = coherency_matrix(M);
    EXPECT_LT((H - H.adjoint()).norm(), 1e-14);
    EXPECT_NEAR(H.trace().real(), M(0, 0), 1e-14);
    EXPECT_LT((mueller_matrix(H) - M).norm(), 1e-13);
  }
}

/// A Jones matrix J acts on the field; its Mueller matrix has a coherency matrix of rank 1, vec(J) vec(J)^dagger up to
/// a change of basis: one eigenvalue, M00, the rest zero.
TEST(Coherency, PureFilmsHaveOneEigenvalue) {
  for (const core::MuellerMatrix& M :
       {core::diattenuator(0.9, 0.2), core::retarder(1.2), core::MuellerMatrix(core::rotator(0.4)),
        core::MuellerMatrix(core::rotator(-0.3) * core::diattenuator(0.5, 0.1) * core::retarder(0.7))}) {
    const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> solver(coherency_matrix(M));
    EXPECT_NEAR(solver.eigenvalues()[3], M(0, 0), 1e-12);
    EXPECT_LT(solver.eigenvalues().head<3>().cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Coherency, EigenvaluesOfADepolarizer) {
  // diag(1, p, p, p): (1 + 3 p) / 4 once and (1 - p) / 4 three times.
  const double p = 0.3;
  const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> solver(coherency_matrix(core::depolarizer(1.0 - p)));
  EXPECT_NEAR(solver.eigenvalues()[3], (1.0 + 3.0 * p) / 4.0, 1e-14);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(solver.eigenvalues()[i], (1.0 - p) / 4.0, 1e-14);
}

TEST(Coherency, AgreesWithTheTestOfCore) {
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {
    core::MuellerMatrix M = random_matrix(random);
    M(0, 0) = 2.0;
    const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> solver(coherency_matrix(M));
    EXPECT_NEAR(solver.eigenvalues()[0] / M(0, 0), core::least_coherency_eigenvalue(M), 1e-12);
  }
}

}  // namespace
}  // namespace evenglow::tracer
