#include "tracer/polarized_bsdf/physical_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

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

/// 1/2 |root (m(V L L^dagger V^dagger) - m(best))|^2.
class Distance final : public ceres::FirstOrderFunction {
 public:
  Distance(const CoherencyMatrix& best, const Root& root, const CoherencyMatrix& basis)
      : best_(best), root_(root), basis_(basis) {}

  CoherencyMatrix matrix(const double* x) const {
    const CoherencyMatrix L = basis_ * lower(x);
    return L * L.adjoint();
  }

  bool Evaluate(const double* x, double* cost, double* gradient) const override {
    const Vector16 residual = residual_of(matrix(x));
    *cost = 0.5 * residual.squaredNorm();
    if (gradient == nullptr) return true;
    // d trace(L L^dagger Z) = 2 Re trace(dL^dagger Z L) for a Hermitian Z.
    const CoherencyMatrix ZL = basis_.adjoint() * combined(residual) * basis_ * lower(x);
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
      const Complex entry = ZL(kPlaces[i].row, kPlaces[i].column);
      gradient[i] = 2.0 * (kPlaces[i].imaginary ? entry.imag() : entry.real());
    }
    return true;
  }
  int NumParameters() const override { return 16; }

  /// Derivative with respect to H.
  CoherencyMatrix slope(const CoherencyMatrix& H) const { return combined(residual_of(H)); }

 private:
  using Vector16 = Eigen::Matrix<double, 16, 1>;

  Vector16 residual_of(const CoherencyMatrix& H) const {
    const core::MuellerMatrix difference = mueller_matrix(H - best_);
    Vector16 entries;
    for (int k = 0; k < 16; ++k) entries[k] = difference(k / 4, k % 4);
    return root_ * entries;
  }

  CoherencyMatrix combined(const Vector16& residual) const {
    const Vector16 by_entry = root_.transpose() * residual;
    CoherencyMatrix Z = CoherencyMatrix::Zero();
    for (int k = 0; k < 16; ++k) Z += by_entry[k] * coherency_basis()[static_cast<std::size_t>(k)];
    return Z;
  }

  const CoherencyMatrix& best_;
  const Root& root_;
  const CoherencyMatrix& basis_;
};

/// Where a fit begins: the eigenvectors V of H, largest eigenvalue first, and L diagonal: H with its eigenvalues raised
/// to the share `floor` of their size. In any other basis a nearly singular H can have small pivots in the wrong
/// places.
struct Start {
  CoherencyMatrix basis;
  std::array<double, 16> x{};

  Start(const CoherencyMatrix& H, double floor) {
    const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> eigen(H);
    basis = eigen.eigenvectors().rowwise().reverse();
    const double least = floor * eigen.eigenvalues().cwiseAbs().sum();
    for (int i = 0; i < 4; ++i) x[static_cast<std::size_t>(i)] = std::sqrt(std::max(least, eigen.eigenvalues()[3 - i]));
  }
};

/// How far the distance at H can be above the least one of all physical matrices, of about the same trace: the duality
/// gap of a convex problem over the cone, Z the derivative at H.
double gap(const CoherencyMatrix& H, const CoherencyMatrix& Z) {
  const Eigen::SelfAdjointEigenSolver<CoherencyMatrix> eigen(Z, Eigen::EigenvaluesOnly);
  return std::max(0.0, (Z * H).trace().real()) + std::max(0.0, -eigen.eigenvalues()[0]) * H.trace().real();
}

ceres::GradientProblemSolver::Options solver_options() {
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 300;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-11;
  options.parameter_tolerance = 1e-15;
  return options;
}

}  // namespace

CoherencyMatrix fit_physical(const CoherencyMatrix& best, const Eigen::Matrix<double, 16, 16>& root) {
  constexpr int kMostStarts = 6;
  constexpr double kFirstFloor = 1e-2;
  constexpr double kNextFloor = 1e-9;
  constexpr double kEnough = 1e-4;  // of chi-square: far below what noise moves it by
  const double scale = best.norm();
  const CoherencyMatrix target = best / scale;
  const Root whitened = root / root.norm();
  const double enough = kEnough / (2.0 * scale * scale * root.squaredNorm());
  CoherencyMatrix H = target;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostStarts; ++i) {
    Start start(H, i == 0 ? kFirstFloor : kNextFloor);
    auto* distance = new Distance(target, whitened, start.basis);
    const ceres::GradientProblem problem(distance);  // which owns it
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(solver_options(), problem, start.x.data(), &summary);
    if (!summary.IsSolutionUsable()) throw core::Error("fit of a physical Mueller matrix failed: " + summary.message);
    if (summary.final_cost > least) break;
    least = summary.final_cost;
    H = distance->matrix(start.x.data());
    if (gap(H, distance->slope(H)) <= enough) break;
  }
  return scale * H;
}

}  // namespace evenglow::tracer
