#pragma once

#include <span>

#include <Eigen/Core>

namespace evenglow::tracer {

/// Reading behind a linear polarizer in the illumination channel, detector blind to polarization.
struct AngleReading {
  double angle = 0.0;  ///< of the polarizer, rad
  double value = 0.0;  ///< luminance over the illuminance behind the polarizer, 1/sr
  double se = 1.0;     ///< standard error, 1/sr, > 0
};

/// How the upward bias of D = hypot(X, Y) is treated. With v = var X + var Y (4 s^2 for four equal readings),
/// E[D^2] = D0^2 + v, and to first order E[D] = D0 + v / (4 D0).
enum class DiattenuationBias {
  none,       ///< D as it comes
  square,     ///< sqrt(max(0, D^2 - v)): D^2 without bias; D itself is then too low by as much as it was too high
  amplitude,  ///< sqrt(max(0, D^2 - v / 2)): D without bias to first order (Wardle & Kronberg, ApJ 194, 1974)
};

/// First row of a film's Mueller matrix, 1/2 (S, -X, -Y): S = tau_max + tau_min, (X, Y) = (tau_max - tau_min)
/// (cos 2 d, sin 2 d), with the covariance of (S, X, Y). 1/sr.
struct FirstRow {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double chi_square = 0.0;     ///< of the readings against the fit
  int degrees_of_freedom = 0;  ///< readings less 3
};

/// What a table holds of one node. tau in 1/sr, delta in rad in (-pi/2, pi/2]: the angle of the tau_min axis, counted
/// as the polarizer was. Standard errors are of first order; that of delta is at most that of a uniform angle
/// (pi / sqrt 12).
struct DiattenuatorValues {
  double tau_min = 0.0, tau_max = 0.0, delta = 0.0;
  double tau_min_se = 0.0, tau_max_se = 0.0, delta_se = 0.0;
  double tau_covariance = 0.0;  ///< of tau_min and tau_max
  bool clipped = false;         ///< (S - D) / 2 was below zero (or S was), and tau_min was set to zero
};

/// Weighted least squares of B_a = 1/2 [S - contrast (X cos 2a + Y sin 2a)]: the corrected equation (6) of Zhdanov et
/// al. 2014 (docs/films.md). For 0, 45, 90, 135 degrees with equal errors it is S = (B0 + B45 + B90 + B135) / 2,
/// X = (B90 - B0) / contrast, Y = (B135 - B45) / contrast, and chi-square is (B0 + B90 - B45 - B135)^2 / (4 s^2).
///
/// `contrast` in (0, 1], see `PrincipalTransmittances`. At least three angles that differ modulo 180 degrees (a
/// promise: throws `core::Error`).
FirstRow fit_first_row(std::span<const AngleReading> readings, double contrast = 1.0);

/// Number of angles that differ modulo 180 degrees (by more than 1e-6 rad).
std::size_t distinct_angles(std::span<const AngleReading> readings);

/// tau_max = (S + D) / 2, tau_min = max(0, (S - D) / 2), delta = 1/2 atan2(Y, X).
DiattenuatorValues diattenuator_values(const FirstRow& row, DiattenuationBias bias = DiattenuationBias::none);

/// `angle` modulo pi, in (-pi/2, pi/2].
double half_turn(double angle);

}  // namespace evenglow::tracer
