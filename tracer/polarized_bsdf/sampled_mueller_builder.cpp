#include "tracer/polarized_bsdf/sampled_mueller_builder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/outgoing_weights.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

constexpr double kReported = 61.0 * core::kRadPerDeg;  ///< incidences up to here count in the remarks
constexpr double kNoDiattenuation = 1e-6;              ///< below it a film has no axis of its own

Eigen::RowVector4d first_row(const std::vector<core::MuellerMatrix>& points, const std::vector<double>& weights) {
  Eigen::RowVector4d sum = Eigen::RowVector4d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i].row(0);
  return sum;
}

}  // namespace

MuellerResampler::MuellerResampler(const MuellerTable& table, double wavelength_nm,
                                   const HemisphericalTable* hemispherical, double pass_index, std::size_t u,
                                   std::size_t phi)
    : table_(table),
      wavelength_nm_(wavelength_nm),
      hemispherical_(hemispherical),
      pass_index_(pass_index),
      u_(u),
      phi_(phi),
      held_(table.axes().sigma.back()) {}

ResampledMuellerNode MuellerResampler::node(double psi, double sigma) {
  ResampledMuellerNode node;
  node.weights = outgoing_weights(u_, phi_, sigma);
  node.kinds = {resampled(ScatterKind::reflection, psi, sigma), resampled(ScatterKind::transmission, psi, sigma)};
  ++nodes_;
  if (hemispherical_ != nullptr) {
    const HemisphericalTable::Row h = hemispherical_->at(sigma);
    normalize(node.kinds[0], node.weights, psi, sigma, h.reflectance_pass, h.reflectance_block);
    normalize(node.kinds[1], node.weights, psi, sigma, h.transmittance_pass, h.transmittance_block);
  }
  if (hemispherical_ == nullptr) hold_totals(node, psi, sigma);
  limit(node);
  return node;
}

void MuellerResampler::hold_totals(ResampledMuellerNode& node, double psi, double sigma) {
  if (!held_.is_beyond(sigma)) return;
  const double last = held_.last_sigma();
  const std::array<double, 2>& edge = held_.at(psi, [&]() -> std::array<double, 2> {
    const std::vector<double> weights = outgoing_weights(u_, phi_, last);
    return {first_row(resampled(ScatterKind::reflection, psi, last), weights)[0],
            first_row(resampled(ScatterKind::transmission, psi, last), weights)[0]};
  });
  for (std::size_t kind = 0; kind < 2; ++kind) {
    const double here = first_row(node.kinds[kind], node.weights)[0];
    if (here <= 0.0) continue;
    for (core::MuellerMatrix& matrix : node.kinds[kind]) matrix *= edge[kind] / here;
  }
}

/// As `Resampler` does it for S: linear interpolation between exact values lies above a convex function by f'' h^2 / 12
/// on average, which is taken off each value.
std::vector<core::MuellerMatrix> MuellerResampler::resampled(ScatterKind kind, double psi, double sigma) const {
  std::vector<core::MuellerMatrix> points(phi_ * (u_ + 1), core::MuellerMatrix::Zero());
  if (!table_.has(kind)) return points;
  const MuellerTable::Slice slice = table_.slice(kind, psi, sigma, wavelength_nm_);
  std::vector<double> S(u_ + 1);
  for (std::size_t k = 0; k < phi_; ++k) {
    core::MuellerMatrix* const line = &points[k * (u_ + 1)];
    const double phi = 2.0 * core::kPi * static_cast<double>(k) / static_cast<double>(phi_);
    for (std::size_t i = 0; i <= u_; ++i) {
      const AxisDirection d = seen_from_axis(sigma, static_cast<double>(i) / static_cast<double>(u_), phi);
      line[i] = slice.at(d.phi, d.theta);
      S[i] = line[i](0, 0);
    }
    for (std::size_t i = 0; i < u_; ++i) {
      const double bend = S[i == 0 ? 1 : i - 1] - 2.0 * S[i] + S[i + 1];
      if (S[i] > 0.0) line[i] *= std::max(0.5, 1.0 - bend / (12.0 * S[i]));
    }
  }
  return points;
}

void MuellerResampler::normalize(std::vector<core::MuellerMatrix>& points, const std::vector<double>& weights,
                                 double psi, double sigma, double pass, double block) {
  // The pass axis that the ray sees, counted from the film's: chi - psi.
  const AxisAngle chi = pass_axis(std::cos(psi), std::sin(psi), std::sin(sigma), pass_index_);
  const double c = chi.cos2 * std::cos(2.0 * psi) + chi.sin2 * std::sin(2.0 * psi);
  const double s = chi.sin2 * std::cos(2.0 * psi) - chi.cos2 * std::sin(2.0 * psi);
  const Eigen::RowVector4d own = first_row(points, weights);
  if (own[0] <= 0.0) {
    if (pass + block > 0.0) ++fallbacks_;
    return;
  }
  // The axis along which the film tells linear polarizations apart; the pass axis if it does not.
  double length = std::hypot(own[1], own[2]), ex = c, ey = s;
  if (length > kNoDiattenuation * own[0]) {
    ex = own[1] / length;
    ey = own[2] / length;
  } else {
    length = 0.0;
  }
  // Pass light lies along that axis by `cosine`: mean +- cosine x half is to be pass and block.
  const double cosine = ex * c + ey * s;
  const double mean = 0.5 * (pass + block), half = 0.5 * (pass - block) / cosine;
  double along = (mean + half) / (own[0] + length), across = (mean - half) / (own[0] - length);
  if (!std::isfinite(along) || !std::isfinite(across) || along < 0.0 || across < 0.0) {
    along = across = mean / own[0];
    ++fallbacks_;
  }
  if (sigma < kReported) {
    least_factor_ = std::min({least_factor_, along, across});
    largest_factor_ = std::max({largest_factor_, along, across});
  }
  const double angle = 0.5 * std::atan2(ey, ex);
  const core::MuellerMatrix before = core::rotator(-angle) * core::diattenuator(along, across) * core::rotator(angle);
  for (core::MuellerMatrix& M : points) M *= before;
}

void MuellerResampler::limit(ResampledMuellerNode& node) {
  const Eigen::RowVector4d own = first_row(node.kinds[0], node.weights) + first_row(node.kinds[1], node.weights);
  const double most = own[0] + own.tail<3>().norm();
  if (most <= 1.0) return;
  for (auto& points : node.kinds) {
    for (core::MuellerMatrix& M : points) M /= most;
  }
  if (most < 1.0 + 1e-6) return;  // rounding of a film that loses nothing
  ++limited_;
  least_limit_ = std::min(least_limit_, 1.0 / most);
}

std::vector<std::string> MuellerResampler::remarks() const {
  std::vector<std::string> remarks;
  const std::string& name = table_.intensities().name();
  if (hemispherical_ != nullptr) {
    remarks.push_back(fmt::format(
        "{}: normalized to the hemispherical table; factors {:.3f} to {:.3f} for incidence up to 60 degrees", name,
        least_factor_, largest_factor_));
  }
  if (const std::string remark = held_.remark(name, hemispherical_ != nullptr); !remark.empty()) {
    remarks.push_back(remark);
  }
  if (fallbacks_ > 0) {
    remarks.push_back(
        fmt::format("{}: at {} of {} incidences the table does not tell pass from block light; both were scaled alike",
                    name, fallbacks_, nodes_));
  }
  if (limited_ > 0) {
    remarks.push_back(fmt::format("{}: R + T above 1 at {} of {} incidences, scaled down by up to {:.2f} %", name,
                                  limited_, nodes_, 100.0 * (1.0 - least_limit_)));
  }
  return remarks;
}

}  // namespace evenglow::tracer
