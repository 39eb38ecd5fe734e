#include "tracer/polarized_bsdf/sampled_bsdf_builder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/outgoing_weights.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

/// Pass and block light at one kind: integrals of tau_min and tau_max and their parts along the pass axis.
struct AxisIntegrals {
  double low = 0.0, low_along = 0.0;    ///< tau_min; tau_min (cos 2 delta, sin 2 delta) . pass
  double high = 0.0, high_along = 0.0;  ///< tau_max; the same
};

AxisIntegrals axis_integrals(const std::vector<ResampledPoint>& points, const std::vector<double>& weights, double c2,
                             double s2) {
  AxisIntegrals a;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ResampledPoint& p = points[i];
    const double length = std::hypot(p.x, p.y);
    const double along = length > 0.0 ? (p.x * c2 + p.y * s2) / length : 0.0;
    const double low = weights[i] * 0.5 * p.S * (1.0 - length);
    const double high = weights[i] * 0.5 * p.S * (1.0 + length);
    a.low += low;
    a.low_along += low * along;
    a.high += high;
    a.high_along += high * along;
  }
  return a;
}

void scale(ResampledPoint& p, double low_factor, double high_factor) {
  const double length = std::hypot(p.x, p.y);
  const double low = low_factor * 0.5 * p.S * (1.0 - length);
  const double high = high_factor * 0.5 * p.S * (1.0 + length);
  p.S = low + high;
  if (length == 0.0 || p.S == 0.0) return;
  const double share = (high - low) / (p.S * length);
  p.x *= share;
  p.y *= share;
}

constexpr double kReported = 61.0 * core::kRadPerDeg;  ///< incidences up to here count in the remarks
constexpr double kNotableError = 0.1;                  ///< of the resampling, in the middle of its intervals

}  // namespace

Resampler::Resampler(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                     double pass_index, const ResamplingShape& shape)
    : table_(table),
      wavelength_nm_(wavelength_nm),
      hemispherical_(hemispherical),
      pass_index_(pass_index),
      shape_(shape),
      has_kappa_(table.least_kappa() < 1.0),
      held_(table.axes().sigma.back()) {}

ResampledNode Resampler::node(double psi, double sigma) {
  ResampledNode node;
  node.weights = outgoing_weights(shape_.u, shape_.phi, sigma);
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

void Resampler::hold_totals(ResampledNode& node, double psi, double sigma) {
  if (!held_.is_beyond(sigma)) return;
  const double last = held_.last_sigma();
  const auto total = [](const std::vector<ResampledPoint>& points, const std::vector<double>& weights) {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i].S;
    return sum;
  };
  const std::array<double, 2>& edge = held_.at(psi, [&]() -> std::array<double, 2> {
    const std::vector<double> weights = outgoing_weights(shape_.u, shape_.phi, last);
    return {total(resampled(ScatterKind::reflection, psi, last), weights),
            total(resampled(ScatterKind::transmission, psi, last), weights)};
  });
  for (std::size_t kind = 0; kind < 2; ++kind) {
    const double here = total(node.kinds[kind], node.weights);
    if (here <= 0.0) continue;
    for (ResampledPoint& p : node.kinds[kind]) p.S *= edge[kind] / here;
  }
}

std::vector<ResampledPoint> Resampler::resampled(ScatterKind kind, double psi, double sigma) {
  std::vector<ResampledPoint> points(shape_.phi * (shape_.u + 1));
  if (!table_.has(kind)) return points;
  const BsdfTable::Slice slice = table_.slice(kind, psi, sigma, wavelength_nm_);
  const auto value = [&](double iu, double iphi) {
    const AxisDirection d = seen_from_axis(sigma, iu / static_cast<double>(shape_.u),
                                           2.0 * core::kPi * iphi / static_cast<double>(shape_.phi));
    return slice.at(d.phi, d.theta);
  };
  for (std::size_t k = 0; k < shape_.phi; ++k) {
    for (std::size_t i = 0; i <= shape_.u; ++i) {
      points[k * (shape_.u + 1) + i] = value(static_cast<double>(i), static_cast<double>(k));
    }
  }
  if (psi == 0.0 && sigma <= kReported) note_error(points, value);
  unbias(points);
  return points;
}

/// Linear interpolation between exact values lies above a convex function: f'' h^2 / 12 on average over an interval.
/// Taking that off each line's value makes the mean error vanish and more than halves its RMS (what is left is the
/// least-squares fit of a piecewise linear function). Along u; S is even in u, so the line beyond u = 0 is the first
/// one.
void Resampler::unbias(std::vector<ResampledPoint>& points) const {
  std::vector<double> S(shape_.u + 1);
  for (std::size_t k = 0; k < shape_.phi; ++k) {
    ResampledPoint* const line = &points[k * (shape_.u + 1)];
    for (std::size_t i = 0; i <= shape_.u; ++i) S[i] = line[i].S;
    for (std::size_t i = 0; i < shape_.u; ++i) {
      const double bend = S[i == 0 ? 1 : i - 1] - 2.0 * S[i] + S[i + 1];
      line[i].S = std::max(0.5 * S[i], S[i] - bend / 12.0);
    }
  }
}

/// Notes the error in the middle of each interval of u, where linear interpolation is worst, weighted by flux.
template <typename Value>
void Resampler::note_error(const std::vector<ResampledPoint>& points, const Value& value) {
  for (std::size_t k = 0; k < shape_.phi; ++k) {
    for (std::size_t i = 0; i < shape_.u; ++i) {
      const ResampledPoint* p = &points[k * (shape_.u + 1) + i];
      const double u = static_cast<double>(i) + 0.5;
      const double S = value(u, static_cast<double>(k)).S;
      error_ += u * u * u * std::abs(0.5 * (p[0].S + p[1].S) - S);
      error_weight_ += u * u * u * S;
    }
  }
}

void Resampler::normalize(std::vector<ResampledPoint>& points, const std::vector<double>& weights, double psi,
                          double sigma, double pass, double block) {
  const AxisAngle film = pass_axis(std::cos(psi), std::sin(psi), std::sin(sigma), pass_index_);
  // The pass axis that the ray sees, counted from the film's: chi - psi.
  const double c2 = film.cos2 * std::cos(2.0 * psi) + film.sin2 * std::sin(2.0 * psi);
  const double s2 = film.sin2 * std::cos(2.0 * psi) - film.cos2 * std::sin(2.0 * psi);
  const AxisIntegrals a = axis_integrals(points, weights, c2, s2);
  // Power for pass light is (S - D along) / 2 = [low (1 + along) + high (1 - along)] / 2, for block light the signs
  // change.
  const double pass_low = 0.5 * (a.low + a.low_along), pass_high = 0.5 * (a.high - a.high_along);
  const double block_low = 0.5 * (a.low - a.low_along), block_high = 0.5 * (a.high + a.high_along);
  if (a.low + a.high <= 0.0) {
    if (pass + block > 0.0) ++fallbacks_;
    return;
  }
  const double determinant = pass_low * block_high - pass_high * block_low;
  double low_factor = (pass * block_high - block * pass_high) / determinant;
  double high_factor = (block * pass_low - pass * block_low) / determinant;
  if (!std::isfinite(low_factor) || !std::isfinite(high_factor) || low_factor < 0.0 || high_factor < 0.0) {
    low_factor = high_factor = (pass + block) / (a.low + a.high);
    ++fallbacks_;
  }
  if (sigma < kReported) {
    least_factor_ = std::min({least_factor_, low_factor, high_factor});
    largest_factor_ = std::max({largest_factor_, low_factor, high_factor});
  }
  for (ResampledPoint& p : points) scale(p, low_factor, high_factor);
}

void Resampler::limit(ResampledNode& node) {
  double S = 0.0, x = 0.0, y = 0.0;
  for (const auto& points : node.kinds) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double weighted = node.weights[i] * points[i].S;
      S += weighted;
      x += weighted * points[i].x;
      y += weighted * points[i].y;
    }
  }
  const double most = 0.5 * (S + std::hypot(x, y));
  if (most <= 1.0) return;
  for (auto& points : node.kinds) {
    for (ResampledPoint& p : points) p.S /= most;
  }
  if (most < 1.0 + 1e-6) return;  // rounding of a film that loses nothing
  ++limited_;
  least_limit_ = std::min(least_limit_, 1.0 / most);
}

std::vector<std::string> Resampler::remarks() const {
  std::vector<std::string> remarks;
  if (hemispherical_ != nullptr) {
    remarks.push_back(fmt::format(
        "{}: normalized to the hemispherical table; factors {:.3f} to {:.3f} for incidence up to 60 degrees",
        table_.name(), least_factor_, largest_factor_));
  }
  if (const std::string remark = held_.remark(table_.name(), hemispherical_ != nullptr); !remark.empty()) {
    remarks.push_back(remark);
  }
  if (fallbacks_ > 0) {
    remarks.push_back(
        fmt::format("{}: at {} of {} incidences the table does not tell pass from block light; both were "
                    "scaled alike",
                    table_.name(), fallbacks_, nodes_));
  }
  if (limited_ > 0) {
    remarks.push_back(fmt::format("{}: R + T above 1 at {} of {} incidences, scaled down by up to {:.2f} %",
                                  table_.name(), limited_, nodes_, 100.0 * (1.0 - least_limit_)));
  }
  if (error_ > kNotableError * error_weight_) {
    remarks.push_back(
        fmt::format("{}: lobes too narrow for the sampling grid; S is {:.0f} % off on average (weighted by flux)",
                    table_.name(), 100.0 * error_ / error_weight_));
  }
  return remarks;
}

}  // namespace evenglow::tracer
