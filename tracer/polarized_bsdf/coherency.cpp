#include "tracer/polarized_bsdf/coherency.h"

namespace evenglow::tracer {
namespace {

std::array<CoherencyMatrix, 16> make_basis() {
  using Complex = std::complex<double>;
  const Complex i(0.0, 1.0);
  std::array<Eigen::Matrix<Complex, 2, 2>, 4> sigma;
  sigma[0] << 1, 0, 0, 1;
  sigma[1] << 1, 0, 0, -1;
  sigma[2] << 0, 1, 1, 0;
  sigma[3] << 0, -i, i, 0;
  std::array<CoherencyMatrix, 16> basis;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      for (int r = 0; r < 4; ++r) {
        for (int c = 0; c < 4; ++c) {
          basis[4 * a + b](r, c) = sigma[a](r / 2, c / 2) * std::conj(sigma[b](r % 2, c % 2));
        }
      }
    }
  }
  return basis;
}

}  // namespace

const std::array<CoherencyMatrix, 16>& coherency_basis() {
  static const std::array<CoherencyMatrix, 16> basis = make_basis();
  return basis;
}

CoherencyMatrix coherency_matrix(const core::MuellerMatrix& M) {
  CoherencyMatrix H = CoherencyMatrix::Zero();
  for (int k = 0; k < 16; ++k) H += 0.25 * M(k / 4, k % 4) * coherency_basis()[static_cast<std::size_t>(k)];
  return H;
}

core::MuellerMatrix mueller_matrix(const CoherencyMatrix& H) {
  core::MuellerMatrix M;
  for (int k = 0; k < 16; ++k) {
    // trace(H B) of two Hermitian matrices.
    M(k / 4, k % 4) = H.conjugate().cwiseProduct(coherency_basis()[static_cast<std::size_t>(k)]).sum().real();
  }
  return M;
}

}  // namespace evenglow::tracer
