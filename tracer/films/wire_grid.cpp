#include "tracer/films/wire_grid.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

using Complex = std::complex<double>;
using Jones = Eigen::Matrix2cd;

/// The Mueller matrix of a Jones matrix; U + iV = 2 E1 conj(E2) (docs/conventions.md).
core::MuellerMatrix mueller_of(const Jones& J) {
  const auto xx = std::norm(J(0, 0)), xy = std::norm(J(0, 1)), yx = std::norm(J(1, 0)), yy = std::norm(J(1, 1));
  const Complex columns_x = J(0, 0) * std::conj(J(0, 1)), columns_y = J(1, 0) * std::conj(J(1, 1));
  const Complex rows_x = J(0, 0) * std::conj(J(1, 0)), rows_y = J(0, 1) * std::conj(J(1, 1));
  const Complex direct = J(0, 0) * std::conj(J(1, 1)), crossed = J(0, 1) * std::conj(J(1, 0));
  core::MuellerMatrix M;
  M << 0.5 * (xx + xy + yx + yy), 0.5 * (xx - xy + yx - yy), (columns_x + columns_y).real(),
      -(columns_x + columns_y).imag(),  //
      0.5 * (xx + xy - yx - yy), 0.5 * (xx - xy - yx + yy), (columns_x - columns_y).real(),
      -(columns_x - columns_y).imag(),                                                                            //
      (rows_x + rows_y).real(), (rows_x - rows_y).real(), (direct + crossed).real(), -(direct - crossed).imag(),  //
      (rows_x + rows_y).imag(), (rows_x - rows_y).imag(), (direct + crossed).imag(), (direct - crossed).real();
  return M;
}

}  // namespace

WireGrid::Walls WireGrid::walls(double transmittance, double reflectance, double sign) {
  const double whole = std::sqrt(transmittance + reflectance);
  if (whole == 0.0) return {};
  const Complex state(std::sqrt(transmittance), sign * std::sqrt(reflectance));
  // t = sqrt T e, r = sign i sqrt R e with e = state / whole.
  return {state * state / whole, -whole};
}

WireGrid::WireGrid(const Powers& p, double axis)
    : pass_(walls(p.transmittance_pass, p.reflectance_pass, 1.0)),
      block_(walls(p.transmittance_block, p.reflectance_block, -1.0)),
      axis_(axis) {
  const auto allowed = [](double t, double r) { return t >= 0.0 && r >= 0.0 && t + r <= 1.0 + 1e-12; };
  core::expects(
      allowed(p.transmittance_pass, p.reflectance_pass) && allowed(p.transmittance_block, p.reflectance_block),
      "a wire grid's T and R are not negative and T + R is at most 1");
}

Bsdf::Specular WireGrid::matrices(const TangentialFrame& frame) const {
  const double cosine = std::max(std::abs(frame.frame.k.z()), 1e-6);
  const double c = axis_.cos_psi(frame), s = axis_.sin_psi(frame);
  Eigen::Matrix2d axes;  // columns: pass axis, wires
  axes << c, -s, s, c;
  const Eigen::Vector2d wave(1.0 / cosine, cosine), root = wave.cwiseSqrt();
  // The tangential field on the wall is (1 + G(sigma)) E_in = 2 (Y0 + Y)^-1 Y0 E_in; (1 + G) taken out of Y lets Y be
  // infinite. Amplitudes times root Y0 count power.
  const auto reflection = [&](Complex pass, Complex block) -> Jones {
    const Eigen::Vector2cd diagonal(pass, block);
    const Jones G = axes.cast<Complex>() * diagonal.asDiagonal() * axes.transpose().cast<Complex>();
    const Jones one = Jones::Identity();
    const Jones sum = wave.cast<Complex>().asDiagonal() * (one + G) + (one - G);
    const Jones field = 2.0 * (one + G) * sum.inverse() * wave.cast<Complex>().asDiagonal();
    return root.cast<Complex>().asDiagonal() * (field - one) * root.cwiseInverse().cast<Complex>().asDiagonal();
  };
  const Jones even = reflection(pass_.even, block_.even), odd = reflection(pass_.odd, block_.odd);
  return {mueller_of(0.5 * (even - odd)), mueller_of(0.5 * (even + odd))};
}

}  // namespace evenglow::tracer
