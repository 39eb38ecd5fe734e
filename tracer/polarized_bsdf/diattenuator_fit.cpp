#include "tracer/polarized_bsdf/diattenuator_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <Eigen/QR>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {

double half_turn(double angle) {
  const double reduced = std::remainder(angle, core::kPi);
  return reduced <= -0.5 * core::kPi ? reduced + core::kPi : reduced;
}

std::size_t distinct_angles(std::span<const AngleReading> readings) {
  constexpr double kSame = 1e-6;
  std::vector<double> angles;
  for (const AngleReading& reading : readings) {
    const auto same = [&](double a) { return std::abs(std::remainder(a - reading.angle, core::kPi)) < kSame; };
    if (std::ranges::none_of(angles, same)) angles.push_back(reading.angle);
  }
  return angles.size();
}

FirstRow fit_first_row(std::span<const AngleReading> readings, double contrast) {
  core::expects(distinct_angles(readings) >= 3, "a fit of three unknowns has readings at three angles");
  const auto count = static_cast<Eigen::Index>(readings.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> design(count, 3);
  Eigen::VectorXd value(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AngleReading& r = readings[static_cast<std::size_t>(i)];
    const double weight = 0.5 / r.se;
    design.row(i) << weight, -weight * contrast * std::cos(2.0 * r.angle), -weight * contrast * std::sin(2.0 * r.angle);
    value[i] = r.value / r.se;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  FirstRow row;
  row.value = qr.solve(value);
  row.chi_square = (value - design * row.value).squaredNorm();
  row.degrees_of_freedom = static_cast<int>(count) - 3;
  const Eigen::Matrix3d R = qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>();
  const Eigen::Matrix3d root = qr.colsPermutation() * R.inverse();
  row.covariance = root * root.transpose();
  return row;
}

DiattenuatorValues diattenuator_values(const FirstRow& row, DiattenuationBias bias) {
  constexpr double kUniform = core::kPi / 3.4641016151377544;  // of an angle that nothing is known about
  const double S = row.value[0];
  const double measured = std::hypot(row.value[1], row.value[2]);
  const Eigen::Matrix3d& C = row.covariance;
  const double v = C(1, 1) + C(2, 2);
  const double taken_off = bias == DiattenuationBias::none ? 0.0 : bias == DiattenuationBias::square ? v : 0.5 * v;
  const double D = taken_off == 0.0 ? measured : std::sqrt(std::max(0.0, measured * measured - taken_off));

  // First-order errors along (X, Y) and across.
  const Eigen::Vector2d along =
      measured > 0.0 ? Eigen::Vector2d(row.value.tail<2>() / measured) : Eigen::Vector2d(1, 0);
  const Eigen::Vector2d across(-along[1], along[0]);
  const Eigen::Matrix2d xy = C.bottomRightCorner<2, 2>();
  const double variance_d = along.dot(xy * along);
  const double across_se = std::sqrt(across.dot(xy * across));
  const double covariance_sd = C(0, 1) * along[0] + C(0, 2) * along[1];

  DiattenuatorValues values;
  const double low = 0.5 * (S - D);
  values.clipped = low < 0.0;
  values.tau_min = std::max(0.0, low);
  values.tau_max = std::max(values.tau_min, 0.5 * (S + D));
  values.delta = measured > 0.0 ? half_turn(0.5 * std::atan2(row.value[2], row.value[1])) : 0.0;
  values.tau_min_se = 0.5 * std::sqrt(std::max(0.0, C(0, 0) + variance_d - 2.0 * covariance_sd));
  values.tau_max_se = 0.5 * std::sqrt(std::max(0.0, C(0, 0) + variance_d + 2.0 * covariance_sd));
  values.tau_covariance = 0.25 * (C(0, 0) - variance_d);
  if (across_se > 0.0) values.delta_se = D > 0.0 ? std::min(kUniform, 0.5 * across_se / D) : kUniform;
  return values;
}

}  // namespace evenglow::tracer
