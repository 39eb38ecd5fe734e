#include "tracer/polarized_bsdf/physical_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <ceres/ceres.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

using Root = Eigen::Matrix<double, 16, 16, Eigen::RowMajor>;
using Complex = std::complex<double>;

/// Real numbers of a lower triangular matrix: 4 real on the diagonal, 6 complex below it.
struct Place {
  int row, column;
  bool imaginary;
};
constexpr std::array<Place, 16> kPlaces{{{0, 0, false},
                                         {1, 1, false},
                                         {2, 2, false},
                                         {3, 3, false},
                                         {1, 0, false},
                                         {1, 0, true},
                                         {2, 0, false},
                                         {2, 0, true},
                                         {2, 1, false},
                                         {2, 1, true},
                                         {3, 0, false},
                                         {3, 0, true},
                                         {3, 1, false},
                                         {3, 1, true},
                                         {3, 2, false},
                                         {3, 2, true}}};

CoherencyMatrix lower(const double* x) {
  CoherencyMatrix L = CoherencyMatrix::Zero();
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const Place& p = kPlaces[i];
    L(p.row, p.column) += p.imaginary ? Complex(0.0, x[i]) : Complex(x[i], 0.0);
  }
  return L;
}

/// root (m(L L^dagger) - m(best)).
class Residuals final : public ceres::SizedCostFunction<16, 16> {
 public:
  Residuals(const CoherencyMatrix& best, const Root& root) : best_(best), root_(root) {}

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const CoherencyMatrix L = lower(parameters[0]);
    const core::MuellerMatrix difference = mueller_matrix(L * L.adjoint() - best_);
    Eigen::Matrix<double, 16, 1> entries;
    for (int k = 0; k < 16; ++k) entries[k] = difference(k / 4, k % 4);
    Eigen::Map<Eigen::Matrix<double, 16, 1>> result(residuals);
    result = root_ * entries;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    // d trace(L L^dagger B) = 2 Re trace(dL^dagger B L) for a Hermitian B.
    Root slope;
    for (int k = 0; k < 16; ++k) {
      const CoherencyMatrix BL = coherency_basis()[static_cast<std::size_t>(k)] * L;
      for (std::size_t i = 0; i < kPlaces.size(); ++i) {
        const Complex entry = BL(kPlaces[i].row, kPlaces[i].column);
        slope(k, static_cast<Eigen::Index>(i)) = 2.0 * (kPlaces[i].imaginary ? entry.imag() : entry.real());
      }
    }
    Eigen::Map<Root> jacobian(jacobians[0]);
    jacobian = root_ * slope;
    return true;
  }

 private:
  const CoherencyMatrix& best_;
  const Root& root_;
};

/// A start inside the cone: the eigenvalues raised to a share of their size.
std::array<double, 16> start(const CoherencyMatrix& best) {
  constexpr double kFloor = 0.01;
  const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> eigen(best);
  const double least = kFloor * eigen.eigenvalues().cwiseAbs().sum();
  const Eigen::Vector4d raised = eigen.eigenvalues().cwiseMax(least);
  const CoherencyMatrix H = eigen.eigenvectors() * raised.asDiagonal() * eigen.eigenvectors().adjoint();
  const CoherencyMatrix L = Eigen::LLT<CoherencyMatrix>(H).matrixL();
  std::array<double, 16> x{};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const Complex entry = L(kPlaces[i].row, kPlaces[i].column);
    x[i] = kPlaces[i].imaginary ? entry.imag() : entry.real();
  }
  return x;
}

}  // namespace

CoherencyMatrix fit_physical(const CoherencyMatrix& best, const Eigen::Matrix<double, 16, 16>& root) {
  const double scale = best.norm();
  const CoherencyMatrix target = best / scale;
  const Root whitened = root * scale;
  std::array<double, 16> x = start(target);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  Residuals residuals(target, whitened);
  problem.AddResidualBlock(&residuals, nullptr, x.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) throw core::Error("fit of a physical Mueller matrix failed: " + summary.message);
  const CoherencyMatrix L = lower(x.data());
  return scale * (L * L.adjoint());
}

}  // namespace evenglow::tracer
